// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkStiffnessArtifacts
 * @brief where the mesh, and not the material, makes a surface feel soft
 *
 * Everything of vtkSurfaceStiffness, and beside it the point arrays `SingleVertexStiffnessNorm` (N/m;
 * without mask, whatever the mask), `StiffnessCondition`, `PrincipalStiffness1`, `2` and `3` (vectors for
 * glyphs: along a principal axis and outwards, as long as the stiffness in N/m, the stiffest first; zero
 * where there is none), `HapticStiffness` (3 by 3, K^H, N/m), `SmoothStiffnessNorm` (N/m; what is left of
 * StiffnessNorm without what varies within the smoothing length), `StiffnessArtifact` and
 * `SingleVertexArtifact` (the norm over its smooth part, minus 1) and `StiffnessJump` (the largest relative
 * jump of the vertex's edges).
 *
 * Field arrays of two values, of single vertices and under the mask: `ArtifactVariation` (standard
 * deviation over mean of the norm over its smooth part, by area), `ArtifactAreaCorrelation` (Spearman's
 * rank correlation with the vertex areas) and `ArtifactLargestJump`.
 *
 * With a second input, another mesh of the body with its `Stiffness` array, `StiffnessChange` is |K| over
 * the other's at the same point, minus 1 (NaN where there is no such point: normals within 60 degrees, no
 * further than one mean edge), and the field array `StiffnessChangeMeasures` its median, its variation,
 * the 95th percentile of its size (all by area), and the number of vertices compared.
 *
 * James & Pai 2001, section 6, fig. 7, table 1; the smooth part is the fit of appendix A (eq. 36) with the
 * biharmonic penalty, to the logarithm.
 */

#ifndef vtkStiffnessArtifacts_h
#define vtkStiffnessArtifacts_h

#include "vtkSurfaceStiffness.h"

class PALPATEELASTOSTATICS_EXPORT vtkStiffnessArtifacts : public vtkSurfaceStiffness
{
public:
  static vtkStiffnessArtifacts* New();
  vtkTypeMacro(vtkStiffnessArtifacts, vtkSurfaceStiffness);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Smoothing length, in the mesh's unit: waves of 2 pi times it pass into the smooth part by half, twice
   * as long ones by 94 %. 0, the default, takes a tenth of the surface's diagonal. Give all meshes
   * that are compared the same.
   */
  vtkSetMacro(SmoothingLength, double);
  vtkGetMacro(SmoothingLength, double);
  ///@}

  ///@{
  /**
   * The second input, optional: another mesh of the body with the array `Stiffness`, e.g. the next
   * finer level's output of this filter.
   */
  void SetReferenceConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetReferenceData(vtkDataObject* data) { this->SetInputData(1, data); }
  ///@}

protected:
  vtkStiffnessArtifacts();
  ~vtkStiffnessArtifacts() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkStiffnessArtifacts(const vtkStiffnessArtifacts&) = delete;
  void operator=(const vtkStiffnessArtifacts&) = delete;

  double SmoothingLength = 0;
};

#endif
