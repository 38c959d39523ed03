// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkFiniteElementGreensFunctions
 * @brief computes the Green's functions of a solid body by finite elements
 *
 * Input 0 is a closed triangle surface with the point array `BoundaryType` and the field data
 * `YoungsModulus` and `PoissonRatio` (vtkReferenceBoundaryConditions). An optional point array
 * `HeldComponents` (uint8, 3: along x, y, z) holds single components of free vertices, as planes of
 * symmetry do; what these bear is not known, so that the inside is seen by Probes alone. Input 1 is optional: an
 * unstructured grid of tetrahedra (quadratic ones count by their corners) whose boundary the surface is,
 * in any order of points. Its cell arrays may give each tetrahedron a material of its own, in SI units:
 * - `YoungsModulus` and `PoissonRatio`;
 * - `TransverselyIsotropicModuli` (5: E and nu along the fibres, E and nu across, G along) with
 *   `FibreDirection` (3);
 * - `OrthotropicModuli` (9: E along the material's axes 1, 2, 3; nu_12, nu_13, nu_23, the first index that
 *   of the stress; G_12, G_13, G_23) with `MaterialAxes` (6: the directions of axes 1 and 2, of which the
 *   second is made square to the first);
 * - `ElasticityTensor` (21: the upper triangle, row by row, of the stiffness of xx, yy, zz, yz, xz, xy
 *   with engineering shear strains).
 * `Density` (1, kg/m^3) says how heavy each is; without it they weigh alike.
 * Without them, and without input 1, the material of the field data fills the body.
 *
 * Without input 1 the surface is filled by CGAL's Mesh_3, with all its vertices kept. Where not all its
 * triangles could be, the output's surface is the boundary of the tetrahedra: point and cell data are
 * carried over, and a warning tells how many triangles differ.
 *
 * The output carries the same arrays as that of vtkBoundaryElementGreensFunctions. Method: displacements
 * linear or quadratic in tetrahedra, pressures of their own where nearly incompressible (C. Taylor and
 * P. Hood, Computers & Fluids 1, 1973), condensed to the vertices of the surface
 * (palpate::computeFiniteElementGreensFunctions). Compliances are symmetric to rounding; with Reciprocal
 * off loads and displacements are each as exact as can be, at sharp edges above all.
 */

#ifndef vtkFiniteElementGreensFunctions_h
#define vtkFiniteElementGreensFunctions_h

#include "vtkGreensFunctionsAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkFiniteElementGreensFunctions : public vtkGreensFunctionsAlgorithm
{
public:
  static vtkFiniteElementGreensFunctions* New();
  vtkTypeMacro(vtkFiniteElementGreensFunctions, vtkGreensFunctionsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Shape functions of the displacement: quadratic (default), or linear, which needs far finer meshes and
   * is refused for Poisson's ratios from 0.45 on.
   */
  enum ElementType
  {
    LINEAR = 0,
    QUADRATIC = 1
  };
  vtkSetClampMacro(Element, int, LINEAR, QUADRATIC);
  vtkGetMacro(Element, int);
  void SetElementToLinear() { this->SetElement(LINEAR); }
  void SetElementToQuadratic() { this->SetElement(QUADRATIC); }
  ///@}

  ///@{
  /**
   * Largest circumradius of the tetrahedra that the surface is filled with, m; 0, the default, lets them
   * grow with the distance from it. Sizes below its edges add vertices to the surface.
   */
  vtkSetMacro(CellSize, double);
  vtkGetMacro(CellSize, double);
  ///@}

  ///@{
  /**
   * Nothing holds the body, and BoundaryType is not read: as Domain UNSUPPORTED of
   * vtkBoundaryElementGreensFunctions. Default off.
   */
  vtkSetMacro(Unsupported, bool);
  vtkGetMacro(Unsupported, bool);
  vtkBooleanMacro(Unsupported, bool);
  ///@}

  ///@{
  /**
   * Places inside the body, m, whose displacement, strain and stress are to be known under any contact:
   * the only way to look into bodies of several or anisotropic materials (vtkInteriorProbe, scenes).
   * None by default; each costs a row of the system.
   */
  void AddProbe(double x, double y, double z);
  void ClearProbes();
  ///@}

  ///@{
  /**
   * Estimate the relative error (palpate::estimateError) on a coarser mesh, or below 200 vertices on a
   * finer one, that is filled anew; not for bodies of several materials. Default on.
   */
  vtkSetMacro(EstimateError, bool);
  vtkGetMacro(EstimateError, bool);
  vtkBooleanMacro(EstimateError, bool);
  ///@}

protected:
  vtkFiniteElementGreensFunctions();
  ~vtkFiniteElementGreensFunctions() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkFiniteElementGreensFunctions(const vtkFiniteElementGreensFunctions&) = delete;
  void operator=(const vtkFiniteElementGreensFunctions&) = delete;

  int Element = QUADRATIC;
  double CellSize = 0;
  bool Unsupported = false;
  std::vector<double> Probes; // three each
  bool EstimateError = true;
  vtkSmartPointer<vtkPolyData> Filled; // the surface that what is kept belongs to
};

#endif
