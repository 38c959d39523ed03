// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_identification_arrays_h
#define palpate_identification_arrays_h

#include "identification/material_identification.h"
#include "identification/measurements.h"
#include "identification/registration.h"

#include <vector>

class vtkPolyData;

/// What was identified as field data (see array_names.h). Not for wrapping.
namespace palpate::convert
{
/// Adds what was identified, but for the material itself; whatever takes the place of these Green's
/// functions takes it away.
void setIdentification(
  vtkPolyData* surface, const MaterialIdentification& result, const Measurements& measurements);
/// Adds probes that would tell most next.
/// @param deviations  a row a probe: of all parameters with the probes up to it.
void setNextProbes(
  vtkPolyData* surface, const std::vector<Probe>& probes, const Eigen::MatrixXd& deviations);
/// Adds what the registration has of the parameters' deviations.
void setRegistrationDeviations(vtkPolyData* surface, const MaterialIdentification& result);
void setRegistration(vtkPolyData* surface, const Registration& registration);
} // namespace palpate::convert

#endif
