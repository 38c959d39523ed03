// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkStiffnessFieldIdentification
 * @brief a body whose stiffness varies inside, and its Green's functions, from measured displacements
 *
 * Inputs are those of vtkGreensFunctionIdentification, method and regions aside: the body is of finite
 * elements always. Its Young's modulus is E_0 exp(s sum a_k b_k), with leading modes b_k of a random field
 * that varies over FieldLength (palpate::stiffnessModes), the standard deviation s of ln E that is expected
 * (FieldDeviation), and a_k that are standard normal before anything is measured. The most probable field
 * is found (palpate::identifyStiffnessField), so that hard or soft places that no measurement sees stay as
 * the rest is. Whatever the field, Green's functions are those of a body: reciprocal, positive definite.
 *
 * Output 0 is the model, as of the base class; its `IdentifiedParameters` are the mean Young's modulus and
 * Poisson's ratio, and its surface is that of the filling with tetrahedra where these need other triangles.
 * Output 1 has the tetrahedra with the cell arrays `YoungsModulus` (Pa), `PoissonRatio` and
 * `LogModulusDeviation`, the standard deviation of ln E that is left, the point array `BoundaryType` and the
 * mean material as field data: by vtkSolidBoundary vtkFiniteElementGreensFunctions takes it as it is. Time goes with a factorisation, and a solution a probe and mode, for each of some ten steps.
 */

#ifndef vtkStiffnessFieldIdentification_h
#define vtkStiffnessFieldIdentification_h

#include "vtkGreensFunctionIdentification.h"

class PALPATEELASTOSTATICS_EXPORT vtkStiffnessFieldIdentification : public vtkGreensFunctionIdentification
{
public:
  static vtkStiffnessFieldIdentification* New();
  vtkTypeMacro(vtkStiffnessFieldIdentification, vtkGreensFunctionIdentification);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many modes the field has (50). More resolve smaller places and take longer.
   */
  vtkSetClampMacro(NumberOfModes, int, 1, 1000);
  vtkGetMacro(NumberOfModes, int);
  ///@}

  ///@{
  /**
   * Over what length stiffness varies, m; 0, the default, for 0.15 of the surface's diagonal.
   */
  vtkSetMacro(FieldLength, double);
  vtkGetMacro(FieldLength, double);
  ///@}

  ///@{
  /**
   * The standard deviation of ln E that is expected (1: factors of three either way are usual); 0, the
   * default, for the one that makes the measurements most probable.
   */
  vtkSetMacro(FieldDeviation, double);
  vtkGetMacro(FieldDeviation, double);
  ///@}

protected:
  vtkStiffnessFieldIdentification();
  ~vtkStiffnessFieldIdentification() override = default;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkStiffnessFieldIdentification(const vtkStiffnessFieldIdentification&) = delete;
  void operator=(const vtkStiffnessFieldIdentification&) = delete;

  int NumberOfModes = 50;
  double FieldLength = 0;
  double FieldDeviation = 0;
};

#endif
