// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

/**
 * @class vtkToleranceGreensFunctions
 * @brief Green's functions that are as accurate as asked for, at the least cost
 *
 * Takes what vtkBoundaryElementGreensFunctions takes and chooses the rest: whether the surface is
 * refined, how often, and with how many layers along the rim of its support (vtkSurfaceRefinement, by
 * Subdivision); the tolerance of the integrals; single or double precision.
 * Levels of a surface that the input controls by Loop's subdivision enclose what that does (LimitShare
 * 0.5).
 * Levels are computed from the coarsest on, until the estimated error of displacements and contact
 * compliances, as 95 % of the loads do not exceed it, is at most ErrorTolerance
 * (palpate::computeToTolerance). The support gets smooth patches of its own (SupportPatch is on).
 * The output is the surface of the level that was chosen with its Green's functions, and its field
 * array `ToleranceSteps` says what was tried. A tolerance that is out of reach is refused with the error
 * that can be reached.
 *
 * Tolerance and Precision are chosen here; ColumnNodes are refused, as levels have other vertices.
 */

#ifndef vtkToleranceGreensFunctions_h
#define vtkToleranceGreensFunctions_h

#include "vtkBoundaryElementGreensFunctions.h"
#include "vtkSurfaceRefinement.h" // for the kinds of subdivision

#include <functional> // for the levels
#include <string>     // for warnings
#include <vector>     // for warnings

namespace palpate
{
struct ToleranceResult;
}

class PALPATEELASTOSTATICS_EXPORT vtkToleranceGreensFunctions
  : public vtkBoundaryElementGreensFunctions
{
public:
  static vtkToleranceGreensFunctions* New();
  vtkTypeMacro(vtkToleranceGreensFunctions, vtkBoundaryElementGreensFunctions);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The largest relative error, above 0 and below 1. Default 0.1.
   */
  vtkSetMacro(ErrorTolerance, double);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  ///@{
  /**
   * How often the surface may be refined; 0 to keep it as it is, also where it controls another. Default
   * 4.
   */
  vtkSetClampMacro(MaximumNumberOfLevels, int, 0, 9);
  vtkGetMacro(MaximumNumberOfLevels, int);
  ///@}

  ///@{
  /**
   * How many layers the surface may get along the rim of its support (vtkSurfaceRefinement's
   * SupportLayers); none if it may not be refined. Default 3.
   */
  vtkSetClampMacro(MaximumNumberOfLayers, int, 0, 9);
  vtkGetMacro(MaximumNumberOfLayers, int);
  ///@}

  ///@{
  /**
   * What the surface stands for when it is refined. Default vtkSurfaceRefinement::FLAT: itself.
   */
  vtkSetClampMacro(Subdivision, int, vtkSurfaceRefinement::LOOP, vtkSurfaceRefinement::CURVED);
  vtkGetMacro(Subdivision, int);
  ///@}

  ///@{
  /**
   * How many vertices the surface may have, refined or not. Default 3000, about a minute on two cores.
   */
  vtkSetClampMacro(MaximumNumberOfVertices, int, 4, 100000);
  vtkGetMacro(MaximumNumberOfVertices, int);
  ///@}

protected:
  vtkToleranceGreensFunctions();
  ~vtkToleranceGreensFunctions() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkToleranceGreensFunctions(const vtkToleranceGreensFunctions&) = delete;
  void operator=(const vtkToleranceGreensFunctions&) = delete;

  vtkSmartPointer<vtkPolyData> Refined(
    vtkPolyData* surface, int levels, int layers, double limitShare);
  palpate::ToleranceResult Search(const std::function<palpate::ElasticModel(int, int)>& mesh);
  void WarnOfVolume(const palpate::ElasticModel& given, const palpate::ElasticModel& refined,
    std::vector<std::string>& warnings) const;

  double ErrorTolerance = 0.1;
  int MaximumNumberOfLevels = 4;
  int MaximumNumberOfLayers = 3;
  int MaximumNumberOfVertices = 3000;
  int Subdivision = vtkSurfaceRefinement::FLAT;
  int Level = 0, Layers = 0;      // that were chosen for the Green's functions that are kept
  std::vector<std::string> Steps; // by which it was
};

#endif
