// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkInteriorProbe.h"

#include "array_names.h"
#include "bem/interior_probes.h"
#include "conversion.h"
#include "stress_arrays.h"

#include "vtkCellArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkStandardNewMacro(vtkInteriorProbe);

/// Integrals over a body for the points inside it.
struct vtkInteriorProbe::Prepared
{
  std::uint64_t Fingerprint;
  double YoungsModulus;
  Eigen::Matrix3Xd Points; // all
  std::vector<int> Inside;
  palpate::InteriorProbes Probes;
};

vtkInteriorProbe::vtkInteriorProbe()
{
  this->SetNumberOfInputPorts(2);
}

vtkInteriorProbe::~vtkInteriorProbe() = default;

void vtkInteriorProbe::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

int vtkInteriorProbe::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

namespace
{
Eigen::Matrix3Xd placesOf(vtkPointSet* set)
{
  Eigen::Matrix3Xd places(3, set->GetNumberOfPoints());
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
  {
    set->GetPoint(i, places.col(i).data());
  }
  return places;
}

/// The points as a surface of their own or, if they are none, as vertices.
void setPoints(vtkPointSet* set, vtkPolyData* output)
{
  output->Initialize();
  if (vtkPolyData* surface = vtkPolyData::SafeDownCast(set))
  {
    output->CopyStructure(surface);
    return;
  }
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  output->SetPoints(set->GetPoints());
  output->SetVerts(vertices);
}
} // namespace

void vtkInteriorProbe::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  namespace convert = palpate::convert;
  namespace arrays = palpate::arrays;
  vtkPointSet* set = vtkPointSet::GetData(inputs[1]);
  const convert::DeformedBody body = convert::deformedBodyOf(input);
  const Eigen::Matrix3Xd places = placesOf(set);
  const std::uint64_t fingerprint = body.model.fingerprint();
  const double young = body.model.material().youngsModulus();
  if (!this->Kept || this->Kept->Fingerprint != fingerprint || this->Kept->YoungsModulus != young ||
    this->Kept->Points.cols() != places.cols() || this->Kept->Points != places)
  {
    this->Kept.reset();
    std::vector<int> inside = palpate::probesInside(body.model, places);
    palpate::InteriorProbes probes(body.model, places(Eigen::all, inside),
      [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); },
      this->NumberOfThreads);
    this->Kept.reset(
      new Prepared{ fingerprint, young, places, std::move(inside), std::move(probes) });
  }
  const std::vector<palpate::ProbedField> fields =
    this->Kept->Probes.evaluate(body.displacement, body.traction);

  const Eigen::Index count = places.cols();
  Eigen::Matrix3Xd displacement = Eigen::Matrix3Xd::Zero(3, count);
  Eigen::VectorXd distance = Eigen::VectorXd::Zero(count), isInside = distance;
  std::vector<Eigen::Matrix3d> gradients(count, Eigen::Matrix3d::Zero()), stresses = gradients;
  for (std::size_t k = 0; k < fields.size(); ++k)
  {
    const int i = this->Kept->Inside[k];
    displacement.col(i) = fields[k].displacement;
    gradients[i] = fields[k].gradient;
    stresses[i] = fields[k].stress;
    distance[i] = this->Kept->Probes.distances()[static_cast<Eigen::Index>(k)];
    isInside[i] = 1;
  }
  setPoints(set, output);
  convert::setPointVectors(output, arrays::Displacement, displacement);
  convert::setStresses(output->GetPointData(), gradients, stresses);
  convert::setPointNumbers(output, arrays::InsideMaterial, isInside);
  convert::setPointNumbers(output, arrays::EdgesFromSurface, distance);
}
