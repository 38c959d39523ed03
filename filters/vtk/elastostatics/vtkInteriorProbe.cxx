// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkInteriorProbe.h"

#include "array_names.h"
#include "bem/interior_probes.h"
#include "conversion.h"
#include "mesh/surface_locator.h"
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

/// The arrays of the output.
class ProbedPoints
{
public:
  explicit ProbedPoints(Eigen::Index count)
    : Displacement(Eigen::Matrix3Xd::Zero(3, count))
    , Distance(Eigen::VectorXd::Zero(count))
    , IsInside(this->Distance)
    , Gradients(count, Eigen::Matrix3d::Zero())
    , Stresses(this->Gradients)
  {
  }

  /// @param distance  from the surface, in edges.
  void Set(int i, const palpate::ProbedField& field, double distance)
  {
    this->Displacement.col(i) = field.displacement;
    this->Gradients[i] = field.gradient;
    this->Stresses[i] = field.stress;
    this->Distance[i] = distance;
    this->IsInside[i] = 1;
  }

  void Write(vtkPointSet* set, vtkPolyData* output) const
  {
    namespace convert = palpate::convert;
    namespace arrays = palpate::arrays;
    setPoints(set, output);
    convert::setPointVectors(output, arrays::Displacement, this->Displacement);
    convert::setStresses(output->GetPointData(), this->Gradients, this->Stresses);
    convert::setPointNumbers(output, arrays::InsideMaterial, this->IsInside);
    convert::setPointNumbers(output, arrays::EdgesFromSurface, this->Distance);
  }

private:
  Eigen::Matrix3Xd Displacement;
  Eigen::VectorXd Distance, IsInside;
  std::vector<Eigen::Matrix3d> Gradients, Stresses;
};

/// Of places whose rows the model carries.
void readRows(const palpate::convert::StoredProbes& probes, vtkPointSet* set, vtkPolyData* output)
{
  const palpate::ProbeRows& rows = probes.rows;
  const palpate::SurfaceLocator locator(probes.mesh);
  ProbedPoints probed(rows.count());
  for (int point = 0; point < rows.count(); ++point)
  {
    palpate::ProbeValues values = palpate::ProbeValues::Zero();
    for (int node = 0; node < rows.nodeCount(); ++node)
    {
      rows.accumulate(point, node, probes.given.col(node), values);
    }
    const Eigen::Vector3d place = rows.points().col(point);
    const Eigen::Vector3d surface = palpate::placeOf(*probes.mesh, locator.nearest(place));
    probed.Set(point, palpate::fieldOf(values, rows.stiffness(point)),
      (surface - place).norm() / probes.mesh->meanEdgeLength());
  }
  probed.Write(set, output);
}
} // namespace

void vtkInteriorProbe::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  namespace convert = palpate::convert;
  vtkPointSet* set = vtkPointSet::GetData(inputs[1]);
  const Eigen::Matrix3Xd places = placesOf(set);
  if (const auto stored = convert::storedProbesOf(input, places))
  {
    readRows(*stored, set, output);
    return;
  }
  const convert::DeformedBody body = convert::deformedBodyOf(input);
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
  ProbedPoints probed(count);
  for (std::size_t k = 0; k < fields.size(); ++k)
  {
    probed.Set(this->Kept->Inside[k], fields[k],
      this->Kept->Probes.distances()[static_cast<Eigen::Index>(k)]);
  }
  probed.Write(set, output);
}
