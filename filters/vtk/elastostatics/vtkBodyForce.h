// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkBodyForce
 * @brief how a body hangs under gravity, or deforms under any acceleration that is the same all over it
 *
 * Input: a model of a body that is held and whose weight is known: an interior one of boundary elements
 * with the Green's functions of all its free vertices, any of finite elements, a shell, or one of these
 * on springs (vtkElasticFoundation; of boundary elements, before). Output: the same with `Displacement`
 * (m) and `Traction` (Pa: those of the support, where the method knows them, else zero) at its points and
 * the field number `LargestDisplacementGradient`.
 *
 * The answers along the three axes are kept: another acceleration or density costs three products a
 * number. Theory and errors: palpate::weightResponse.
 */

#ifndef vtkBodyForce_h
#define vtkBodyForce_h

#include "vtkElastostaticAlgorithm.h"

#include <memory> // for what is kept

class PALPATEELASTOSTATICS_EXPORT vtkBodyForce : public vtkElastostaticAlgorithm
{
public:
  static vtkBodyForce* New();
  vtkTypeMacro(vtkBodyForce, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Acceleration of gravity, m/s^2, default (0, 0, -9.81). A body that is accelerated itself feels the
   * opposite.
   */
  vtkSetVector3Macro(Acceleration, double);
  vtkGetVector3Macro(Acceleration, double);
  ///@}

  ///@{
  /**
   * Density in the mean, kg/m^3; 0, the default, for the model's field number `Density`.
   */
  vtkSetMacro(Density, double);
  vtkGetMacro(Density, double);
  ///@}

protected:
  vtkBodyForce();
  ~vtkBodyForce() override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkBodyForce(const vtkBodyForce&) = delete;
  void operator=(const vtkBodyForce&) = delete;

  double Acceleration[3] = { 0, 0, -9.81 };
  double Density = 0;

  struct Prepared;
  std::unique_ptr<Prepared> Kept;
};

#endif
