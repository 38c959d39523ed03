// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkSurfaceRefinement
 * @brief subdivides a closed surface and carries its data along
 *
 * Each level splits every triangle in four. Old vertices keep their numbers. A new vertex is fixed if
 * both ends of its edge are; other point data are the mean of the ends'. Triangles inherit cell data.
 * Green's functions, vertex areas, stiffnesses and results of contacts are dropped, as they belong to
 * the coarse mesh, and so are smooth patches that were found, not given, unless Subdivision is curved.
 *
 * By LimitShare of Loop's subdivision, vertices are then moved towards where more levels would lead
 * them, on the smooth surface that the input controls (palpate::loopLimit).
 *
 * SupportLayers then cut the triangles along the rim of the support into layers that get thinner towards
 * it (palpate::gradeTowardsSupport), where stresses are singular and most of the error of Green's
 * functions comes from. They leave the surface where it is.
 */

#ifndef vtkSurfaceRefinement_h
#define vtkSurfaceRefinement_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkSurfaceRefinement : public vtkElastostaticAlgorithm
{
public:
  static vtkSurfaceRefinement* New();
  vtkTypeMacro(vtkSurfaceRefinement, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How often every triangle is split in four, 0 to 8. Default 1.
   */
  vtkSetClampMacro(NumberOfLevels, int, 0, 8);
  vtkGetMacro(NumberOfLevels, int);
  ///@}

  ///@{
  /**
   * Layers on either side of the support's rim, 0 to 9; the input then needs a point array
   * `BoundaryType`. Default 0.
   */
  vtkSetClampMacro(SupportLayers, int, 0, 9);
  vtkGetMacro(SupportLayers, int);
  ///@}

  ///@{
  /**
   * What the surface stands for: the control mesh of a smooth one, towards which its vertices move (C.
   * Loop 1987; James & Pai 2001, section 3.2; OpenMesh); itself, flat triangles and all; or a surface
   * through its vertices, smooth but for its sharp edges, which stay (A. Vlachos et al. 2001). Default
   * Loop.
   */
  enum SubdivisionType
  {
    LOOP = 0,
    FLAT = 1,
    CURVED = 2
  };
  vtkSetClampMacro(Subdivision, int, LOOP, CURVED);
  vtkGetMacro(Subdivision, int);
  void SetSubdivisionToLoop() { this->SetSubdivision(LOOP); }
  void SetSubdivisionToFlat() { this->SetSubdivision(FLAT); }
  void SetSubdivisionToCurved() { this->SetSubdivision(CURVED); }
  ///@}

  ///@{
  /**
   * How far vertices are moved, after the levels, from where Loop's subdivision has them to the smooth
   * surface that it tends to, from 0 to 1. Where that curves outwards, its levels are too large by half of
   * this way and chords of the surface (1) too small by the other half; in between (0.5) a mesh encloses
   * what the surface does. What was moved is no control mesh of the surface any more. Of the other
   * subdivisions it changes nothing, as their vertices stay. Default 0.
   */
  vtkSetClampMacro(LimitShare, double, 0, 1);
  vtkGetMacro(LimitShare, double);
  ///@}

  ///@{
  /**
   * Edges whose triangles' normals differ by more than this angle (degrees, default 30) are sharp for
   * the curved subdivision, unless the input has a cell array `SmoothPatch`.
   */
  vtkSetMacro(SmoothAngle, double);
  vtkGetMacro(SmoothAngle, double);
  ///@}

protected:
  vtkSurfaceRefinement() = default;
  ~vtkSurfaceRefinement() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkSurfaceRefinement(const vtkSurfaceRefinement&) = delete;
  void operator=(const vtkSurfaceRefinement&) = delete;

  int NumberOfLevels = 1;
  int SupportLayers = 0;
  int Subdivision = LOOP;
  double LimitShare = 0;
  double SmoothAngle = 30;
};

#endif
