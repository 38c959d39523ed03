// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkIdentificationByCrossValidation
 * @brief the most constrained of three models of a measured body that predicts probes left out well
 *
 * Inputs and settings are those of vtkGreensFunctionIdentification and vtkStiffnessFieldIdentification. Three
 * models are identified, from the most constrained on: of one material (or one a region), with boundary or
 * finite elements; with finite elements on a firm support, of stiffness that varies inside; and the first
 * with its compliance corrected (vtkComplianceCorrection). Each predicts probes that it was not identified
 * from (`HoldOutError`). Taken is the first whose error is within a twentieth of the least, or larger by
 * less than the standard error of the difference over probes; all are judged by the same displacements,
 * those that not every one of them takes for outliers.
 *
 * Output 0 is the model that was taken, with the field data `TriedModels` (names) and `TriedHoldOutErrors`
 * (over those displacements), NaN for one that could not be identified, whose reason is in `Warnings`. Output 1 has the tetrahedra of the
 * field if that was taken, and else nothing.
 */

#ifndef vtkIdentificationByCrossValidation_h
#define vtkIdentificationByCrossValidation_h

#include "vtkStiffnessFieldIdentification.h"

class PALPATEELASTOSTATICS_EXPORT vtkIdentificationByCrossValidation
  : public vtkStiffnessFieldIdentification
{
public:
  static vtkIdentificationByCrossValidation* New();
  vtkTypeMacro(vtkIdentificationByCrossValidation, vtkStiffnessFieldIdentification);

protected:
  vtkIdentificationByCrossValidation();
  ~vtkIdentificationByCrossValidation() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkIdentificationByCrossValidation(const vtkIdentificationByCrossValidation&) = delete;
  void operator=(const vtkIdentificationByCrossValidation&) = delete;

  void Correct(vtkPolyData* prior, vtkPolyData* output);
};

#endif
