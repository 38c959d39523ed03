// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkMaskedContactAlgorithm
 * @brief the pressure mask's settings, for the filters that use one
 *
 * A vertex pressure mask spreads a point-like force over the free nodes around a vertex, so that the
 * contact has a size of its own, whatever the mesh (James & Pai 2001, section 6.1). A radius below the
 * edge length, such as the default 0, is the single vertex.
 */

#ifndef vtkMaskedContactAlgorithm_h
#define vtkMaskedContactAlgorithm_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkMaskedContactAlgorithm : public vtkElastostaticAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkMaskedContactAlgorithm, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How the pressure falls with distance over radius, t: linear 1 - t (default, the paper's); uniform;
   * gaussian exp(-(3t)^2/2); hertzian sqrt(1 - t^2).
   */
  enum MaskType
  {
    LINEAR = 0,
    UNIFORM = 1,
    GAUSSIAN = 2,
    HERTZIAN = 3
  };
  vtkSetClampMacro(Mask, int, LINEAR, HERTZIAN);
  vtkGetMacro(Mask, int);
  void SetMaskToLinear() { this->SetMask(LINEAR); }
  void SetMaskToUniform() { this->SetMask(UNIFORM); }
  void SetMaskToGaussian() { this->SetMask(GAUSSIAN); }
  void SetMaskToHertzian() { this->SetMask(HERTZIAN); }
  ///@}

  ///@{
  /**
   * Radius of the mask, >= 0, in the unit of the points or in mean edge lengths. Default 0.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  vtkSetMacro(RadiusInEdgeLengths, bool);
  vtkGetMacro(RadiusInEdgeLengths, bool);
  vtkBooleanMacro(RadiusInEdgeLengths, bool);
  ///@}

protected:
  vtkMaskedContactAlgorithm() = default;
  ~vtkMaskedContactAlgorithm() override = default;

  /**
   * The radius in the unit of the points.
   */
  double RadiusFor(double meanEdgeLength) const
  {
    return this->RadiusInEdgeLengths ? this->Radius * meanEdgeLength : this->Radius;
  }

  int Mask = LINEAR;
  double Radius = 0;
  bool RadiusInEdgeLengths = false;

private:
  vtkMaskedContactAlgorithm(const vtkMaskedContactAlgorithm&) = delete;
  void operator=(const vtkMaskedContactAlgorithm&) = delete;
};

#endif
