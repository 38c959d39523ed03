// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkComplianceCorrection
 * @brief corrects a model's Green's functions by measured displacements, without a model of the inside
 *
 * Input 0 is a model with the Green's functions of all its free vertices, of any method, reciprocal.
 * Measurements are a file (palpate::readMeasurementFile) or input 1: polydata with the table as field data.
 * The compliance between free vertices becomes a factor times the prior's and a correction: what was
 * measured is kept but for noise, by reciprocity also its mirror image, and between and beyond it goes over
 * to the prior smoothly (palpate::correctCompliance). NumberOfModes confines the correction to the prior's
 * leading modes. How far the measurements are trusted is chosen by probes left out in turn.
 *
 * The output is the model corrected, which all that takes models takes, of no known material. Its
 * `HoldOutError` is the error under probes left out, `PriorHoldOutError` that of the prior with the factor
 * that fits best; `IdentifiedParameters` holds the factor. Support columns, if there are any, are kept.
 */

#ifndef vtkComplianceCorrection_h
#define vtkComplianceCorrection_h

#include "vtkElastostaticAlgorithm.h"

#include <string> // for names

class PALPATEELASTOSTATICS_EXPORT vtkComplianceCorrection : public vtkElastostaticAlgorithm
{
public:
  static vtkComplianceCorrection* New();
  vtkTypeMacro(vtkComplianceCorrection, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The table of measurements, in these units (as vtkImportedGreensFunctions has them); without a file
   * input 1 is taken. The file is read when the filter executes.
   */
  void SetMeasurementFileName(const char* name);
  const char* GetMeasurementFileName() const { return this->MeasurementFileName.c_str(); }
  void SetLengthUnit(const char* unit);
  const char* GetLengthUnit() const { return this->LengthUnit.c_str(); }
  void SetForceUnit(const char* unit);
  const char* GetForceUnit() const { return this->ForceUnit.c_str(); }
  ///@}

  ///@{
  /**
   * How many leading modes of the prior's compliance the correction has; 0, the default, for all.
   */
  vtkSetMacro(NumberOfModes, int);
  vtkGetMacro(NumberOfModes, int);
  ///@}

  ///@{
  /**
   * Noise over what is corrected, variances; 0, the default, to choose it by probes left out.
   */
  vtkSetMacro(Smoothing, double);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * Folds of the cross-validation by probes (5; 0 for none, which takes a Smoothing).
   */
  vtkSetClampMacro(NumberOfFolds, int, 0, 1000);
  vtkGetMacro(NumberOfFolds, int);
  ///@}

  ///@{
  /**
   * Leave out displacements that contradict the rest. Default on.
   */
  vtkSetMacro(LeaveOutOutliers, bool);
  vtkGetMacro(LeaveOutOutliers, bool);
  vtkBooleanMacro(LeaveOutOutliers, bool);
  ///@}

  ///@{
  /**
   * How far a place may be from the surface, over its diagonal (0.02).
   */
  vtkSetMacro(PlaceTolerance, double);
  vtkGetMacro(PlaceTolerance, double);
  ///@}

protected:
  vtkComplianceCorrection();
  ~vtkComplianceCorrection() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkComplianceCorrection(const vtkComplianceCorrection&) = delete;
  void operator=(const vtkComplianceCorrection&) = delete;

  int NumberOfModes = 0;
  int NumberOfFolds = 5;
  double Smoothing = 0;
  double PlaceTolerance = 0.02;
  bool LeaveOutOutliers = true;
  std::string MeasurementFileName, LengthUnit = "m", ForceUnit = "N";
};

#endif
