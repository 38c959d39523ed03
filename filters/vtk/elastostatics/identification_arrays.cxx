// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "measurement_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <string>

namespace palpate::convert
{
namespace
{
void setTuples(vtkPolyData* table, const char* name, const Eigen::MatrixXd& rows)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(rows.cols()));
  array->SetNumberOfTuples(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
  {
    for (Eigen::Index j = 0; j < rows.cols(); ++j)
    {
      array->SetComponent(i, static_cast<int>(j), rows(i, j));
    }
  }
  table->GetFieldData()->AddArray(array);
}
} // namespace

void setIdentification(
  vtkPolyData* surface, const MaterialIdentification& result, const Measurements& measurements)
{
  setMeasurements(surface, measurements);
  setVectorsWithGaps(surface, arrays::MeasurementResidual, result.residuals);
  if (result.heldOutResiduals.size() > 0)
  {
    setVectorsWithGaps(surface, arrays::MeasurementHeldOutResidual, result.heldOutResiduals);
  }
  vtkNew<vtkUnsignedCharArray> outliers;
  outliers->SetName(arrays::MeasurementOutlier);
  outliers->SetNumberOfTuples(result.residuals.cols());
  outliers->Fill(0);
  for (int i : result.outliers)
  {
    outliers->SetValue(i, 1);
  }
  surface->GetFieldData()->AddArray(outliers);
  std::vector<double> residuals, relative, counts;
  for (const ProbeFit& probe : result.probes)
  {
    residuals.push_back(probe.residual);
    relative.push_back(probe.relative);
    counts.push_back(probe.outliers);
  }
  setColumn(surface, arrays::ProbeResidual, residuals);
  setColumn(surface, arrays::ProbeRelativeResidual, relative);
  setColumn(surface, arrays::ProbeOutliers, counts);
  std::vector<std::string> names, units;
  Eigen::MatrixXd values(result.parameters.size(), 4);
  double poissonDeviation = 0;
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
  {
    const IdentifiedParameter& p = result.parameters[i];
    names.push_back(p.name);
    units.push_back(p.unit);
    values.row(i) << p.value, p.deviation, p.lower, p.upper;
    poissonDeviation = p.name == "Poisson's ratio" ? p.deviation : poissonDeviation;
  }
  setFieldStrings(surface, arrays::IdentifiedNames, names);
  setFieldStrings(surface, arrays::IdentifiedUnits, units);
  setTuples(surface, arrays::IdentifiedParameters, values);
  setTuples(surface, arrays::IdentifiedCorrelations, result.correlations);
  setFieldNumber(surface, arrays::YoungsModulusDeviation, result.parameters.front().deviation);
  setFieldNumber(surface, arrays::PoissonRatioDeviation, poissonDeviation);
  setFieldNumber(surface, arrays::SupportYieldLength, result.foundationLength);
  setFieldNumber(surface, arrays::MeasurementNoise, result.noise);
  setFieldNumber(surface, arrays::MeasurementMisfit, result.misfit);
  setFieldNumber(surface, arrays::HoldOutError, result.holdOutError);
  setFieldNumber(surface, arrays::FitError, result.fitError);
  setFieldNumbers(surface, arrays::NeighbourCorrelation,
    { result.neighbours.correlation, result.neighbours.byChance });
  std::vector<double> probewise;
  for (const IdentifiedParameter& p : result.parameters)
  {
    probewise.push_back(p.probewiseDeviation);
  }
  setColumn(surface, arrays::ProbewiseDeviation, probewise);
  setFieldNumber(surface, arrays::ResponseInterpolationError, result.interpolationError);
}

void setNextProbes(
  vtkPolyData* surface, const std::vector<Probe>& probes, const Eigen::MatrixXd& deviations)
{
  vtkNew<vtkIdTypeArray> vertices;
  vertices->SetName(arrays::NextProbeVertex);
  Eigen::Matrix3Xd forces(3, probes.size());
  for (std::size_t i = 0; i < probes.size(); ++i)
  {
    vertices->InsertNextValue(probes[i].contact.vertex);
    forces.col(i) = probes[i].force;
  }
  surface->GetFieldData()->AddArray(vertices);
  setFieldVectors(surface, arrays::NextProbeForce, forces);
  setTuples(surface, arrays::NextProbeDeviations, deviations);
}

void setRegistrationDeviations(vtkPolyData* surface, const MaterialIdentification& result)
{
  std::vector<double> shares;
  for (const IdentifiedParameter& p : result.parameters)
  {
    shares.push_back(p.registrationDeviation);
  }
  setColumn(surface, arrays::ParameterDeviationByRegistration, shares);
}

void setRegistration(vtkPolyData* surface, const Registration& registration)
{
  std::vector<double> rotation, deviations;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      rotation.push_back(registration.rotation(i, j));
    }
  }
  for (int i = 0; i < 6; ++i)
  {
    deviations.push_back(
      i < 3 ? registration.rotationDeviation[i] : registration.translationDeviation[i - 3]);
  }
  setFieldNumbers(surface, arrays::RegistrationRotation, rotation);
  setFieldVector(surface, arrays::RegistrationTranslation, registration.translation);
  setFieldNumbers(surface, arrays::RegistrationDeviation, deviations);
  setFieldNumber(surface, arrays::RegistrationDistance, registration.distance);
}
} // namespace palpate::convert
