// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkElasticFoundation
 * @brief puts a model on springs: an elastic foundation in place of its firm support, and single springs
 *
 * Input: a model with the Green's functions of all its free vertices and of the fixed ones that are to
 * move on springs (ColumnNodes of the filter that makes it). Output: the model with the springs in it,
 * which presses, stiffnesses, contacts and scenes take as any other.
 *
 * Springs are those of the foundation under what is fixed (E. Winkler 1867), and those of the input's
 * optional point array `SpringStiffness`: one number a vertex, the same in all directions, or the nine of
 * a symmetric block row by row; N/m. Fixed vertices without any stay fixed. A body that nothing holds
 * (Domain UNSUPPORTED) needs springs that resist all of its motions. Nothing is computed anew: the result
 * is exact for the Green's functions given (palpate::onElasticFoundation), and rigid supports are its
 * limit. Young's modulus scales the springs with the body. Constraints with springs of vtkCapacitanceSolve
 * give the same without a model of their own.
 */

#ifndef vtkElasticFoundation_h
#define vtkElasticFoundation_h

#include "vtkElastostaticAlgorithm.h"

#include <vector>

class PALPATEELASTOSTATICS_EXPORT vtkElasticFoundation : public vtkElastostaticAlgorithm
{
public:
  static vtkElasticFoundation* New();
  vtkTypeMacro(vtkElasticFoundation, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Stiffness of the foundation under fixed vertices, Pa/m, along the surface's normal. 0, the default,
   * for none.
   */
  vtkSetMacro(NormalStiffness, double);
  vtkGetMacro(NormalStiffness, double);
  ///@}

  ///@{
  /**
   * The same along the surface; negative, the default, for that along the normal.
   */
  vtkSetMacro(ShearStiffness, double);
  vtkGetMacro(ShearStiffness, double);
  ///@}

  ///@{
  /**
   * Places inside the body, m, whose displacement, strain and stress are to be known under any contact
   * (vtkInteriorProbe, scenes). Of a model whose Green's functions have probes they must be some of these;
   * else it must be homogeneous and isotropic. Without any, the model keeps the probes it has.
   */
  void AddProbe(double x, double y, double z);
  void ClearProbes();
  ///@}

protected:
  vtkElasticFoundation() = default;
  ~vtkElasticFoundation() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkElasticFoundation(const vtkElasticFoundation&) = delete;
  void operator=(const vtkElasticFoundation&) = delete;

  double NormalStiffness = 0;
  double ShearStiffness = -1;
  std::vector<double> Probes; // three each
};

#endif
