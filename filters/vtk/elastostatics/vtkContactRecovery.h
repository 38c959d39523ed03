// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkContactRecovery
 * @brief the contacts that displacements of a body's surface are due to
 *
 * Input 0 is a model: a surface with Green's functions. The displacements of some points of it, under
 * contacts that nobody knows, are a file (palpate::readObservationFile), or input 1: polydata with field
 * arrays (see array_names.h, `MeasuredDisplacement` with `MeasurementPoint` or `MeasurementVertex`,
 * optionally `MeasurementDeviation` and `MeasurementProbe`; those of probes' forces are passed over).
 *
 * The output is the model with `Traction`, `Displacement`, `ContactPressure` with its standard deviation
 * and `ContactNumber` at its points, and as field data a tuple a contact: `ContactForce`, `ContactTorque`,
 * `ContactCentre`, `ContactPeak` and more, with deviations by noise. Method: few compact loads in the
 * cones of contact, palpate::recoverContacts. What is doubtful is said in `RecoveryWarnings`.
 */

#ifndef vtkContactRecovery_h
#define vtkContactRecovery_h

#include "vtkElastostaticAlgorithm.h"

#include <string> // for names

class PALPATEELASTOSTATICS_EXPORT vtkContactRecovery : public vtkElastostaticAlgorithm
{
public:
  static vtkContactRecovery* New();
  vtkTypeMacro(vtkContactRecovery, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The table of displacements, in this unit of length (as vtkImportedGreensFunctions has them); without a
   * file input 1 is taken. The file is read when the filter executes.
   */
  void SetDisplacementFileName(const char* name);
  const char* GetDisplacementFileName() const { return this->DisplacementFileName.c_str(); }
  void SetLengthUnit(const char* unit);
  const char* GetLengthUnit() const { return this->LengthUnit.c_str(); }
  ///@}

  ///@{
  /**
   * Which probe's displacements of a table of several; empty, the default, where there is one.
   */
  void SetProbeName(const char* name);
  const char* GetProbeName() const { return this->ProbeName.c_str(); }
  ///@}

  ///@{
  /**
   * Largest tangential over normal force (0.5); 0 for contacts without friction.
   */
  vtkSetMacro(Friction, double);
  vtkGetMacro(Friction, double);
  ///@}

  ///@{
  /**
   * Standard deviation of a displacement's component, m; 0, the default, for what the table says, or else
   * what the residuals tell.
   */
  vtkSetMacro(Noise, double);
  vtkGetMacro(Noise, double);
  ///@}

  ///@{
  /**
   * Radius of the patches that forces are spread over, m: 0 for single vertices; negative, the default, as
   * the displacements tell.
   */
  vtkSetMacro(PatchRadius, double);
  vtkGetMacro(PatchRadius, double);
  ///@}

  ///@{
  /**
   * Let the support give way more or less than the model's, where the displacements tell. Default on.
   */
  vtkSetMacro(YieldingSupport, bool);
  vtkGetMacro(YieldingSupport, bool);
  vtkBooleanMacro(YieldingSupport, bool);
  ///@}

  ///@{
  /**
   * Sets of noise that the deviations are found from (50; 0 for none), and their seed (1).
   */
  vtkSetClampMacro(NumberOfSamples, int, 0, 100000);
  vtkGetMacro(NumberOfSamples, int);
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * How far a place may be from the surface, over its diagonal (0.02).
   */
  vtkSetMacro(PlaceTolerance, double);
  vtkGetMacro(PlaceTolerance, double);
  ///@}

protected:
  vtkContactRecovery();
  ~vtkContactRecovery() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkContactRecovery(const vtkContactRecovery&) = delete;
  void operator=(const vtkContactRecovery&) = delete;

  double Friction = 0.5;
  double Noise = 0;
  double PatchRadius = -1;
  double PlaceTolerance = 0.02;
  int NumberOfSamples = 50;
  int Seed = 1;
  bool YieldingSupport = true;
  std::string DisplacementFileName, ProbeName, LengthUnit = "m";
};

#endif
