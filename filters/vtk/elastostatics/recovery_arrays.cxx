// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "recovery_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "measurement_arrays.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace palpate::convert
{
void setRecovery(vtkPolyData* surface, const ContactRecovery& recovery, const Eigen::Matrix3Xd& places,
  const Eigen::Matrix3Xd& displacements)
{
  removeContact(surface);
  setPointVectors(surface, arrays::Displacement, recovery.displacement);
  setPointVectors(surface, arrays::Traction, recovery.traction);
  setPointNumbers(surface, arrays::ContactPressure, recovery.pressure);
  setPointNumbers(surface, arrays::ContactPressureDeviation, recovery.pressureDeviation);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName(arrays::ContactNumber);
  numbers->SetNumberOfTuples(surface->GetNumberOfPoints());
  numbers->Fill(0);
  const Eigen::Index count = recovery.contacts.size();
  Eigen::Matrix3Xd forces(3, count), deviations(3, count), centres(3, count), torques(3, count);
  std::vector<double> centreDeviations, pressures, areas;
  vtkNew<vtkIdTypeArray> peaks;
  peaks->SetName(arrays::ContactPeak);
  for (Eigen::Index c = count; c-- > 0;) // where two overlap, the stronger's number stays
  {
    const RecoveredContact& contact = recovery.contacts[c];
    for (int node : contact.nodes)
    {
      numbers->SetValue(node, static_cast<int>(c) + 1);
    }
    forces.col(c) = contact.force;
    deviations.col(c) = contact.forceDeviation;
    centres.col(c) = contact.centre;
    torques.col(c) = contact.torque;
  }
  for (const RecoveredContact& contact : recovery.contacts)
  {
    peaks->InsertNextValue(contact.peak);
    centreDeviations.push_back(contact.centreDeviation);
    pressures.push_back(contact.pressure);
    areas.push_back(contact.area);
  }
  surface->GetPointData()->AddArray(numbers);
  surface->GetFieldData()->AddArray(peaks);
  setFieldVectors(surface, arrays::ContactForce, forces);
  setFieldVectors(surface, arrays::ContactForceDeviation, deviations);
  setFieldVectors(surface, arrays::ContactCentre, centres);
  setFieldVectors(surface, arrays::ContactTorque, torques);
  setColumn(surface, arrays::ContactCentreDeviation, centreDeviations);
  setColumn(surface, arrays::ContactPeakPressure, pressures);
  setColumn(surface, arrays::ContactArea, areas);
  setFieldVector(surface, arrays::RecoveredForce, recovery.force);
  setFieldVector(surface, arrays::RecoveredForceDeviation, recovery.forceDeviation);
  setFieldVectors(surface, arrays::ObservedPoint, places);
  setVectorsWithGaps(surface, arrays::ObservedDisplacement, displacements);
  setVectorsWithGaps(surface, arrays::ObservedResidual, recovery.residuals);
  setFieldNumber(surface, arrays::ObservationNoise, recovery.noise);
  setFieldNumber(surface, arrays::ObservationMisfit, recovery.misfit);
  setFieldNumber(surface, arrays::LoadPatchRadius, recovery.radius);
  setFieldNumbers(
    surface, arrays::RecoveredSupportYield, { recovery.yield.translation, recovery.yield.rotation });
  setFieldNumber(surface, arrays::SupportYieldShare, recovery.yieldShare);
  setFieldStrings(surface, arrays::RecoveryWarnings, recovery.warnings);
}
} // namespace palpate::convert
