// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkBoundaryElementGreensFunctions
 * @brief computes the Green's functions of an elastic surface by boundary elements
 *
 * The input is a closed triangle surface with the point array `BoundaryType` and the field data
 * `YoungsModulus` and `PoissonRatio` (vtkReferenceBoundaryConditions). The output carries, besides, the
 * field arrays `GreensFunctions`, `GreensFunctionNodes`, provenance and diagnostics (array_names.h),
 * and is all that the other filters need: it can be written to a .vtp file and read again.
 *
 * Method: collocation of the boundary integral equation with linear displacements and tractions on
 * flat triangles; D. L. James and D. K. Pai, "A unified treatment of elastostatic contact simulation
 * for real time haptics", Haptics-e 2(1), 2001, sections 3.3 to 3.6.
 */

#ifndef vtkBoundaryElementGreensFunctions_h
#define vtkBoundaryElementGreensFunctions_h

#include "vtkGreensFunctionsAlgorithm.h"

namespace palpate
{
struct BoundaryElementOptions;
}

class PALPATEELASTOSTATICS_EXPORT vtkBoundaryElementGreensFunctions
  : public vtkGreensFunctionsAlgorithm
{
public:
  static vtkBoundaryElementGreensFunctions* New();
  vtkTypeMacro(vtkBoundaryElementGreensFunctions, vtkGreensFunctionsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Arithmetic and storage: double; mixed (factored in float, refined to 1e-11 and stored in double:
   * faster than double where a few percent of the columns are wanted, slower where all are, as each
   * refinement multiplies the system by them); float (half the memory and time, about 1e-5 relative).
   * Default double.
   */
  enum PrecisionType
  {
    DOUBLE = 0,
    MIXED = 1,
    FLOAT = 2
  };
  vtkSetClampMacro(Precision, int, DOUBLE, FLOAT);
  vtkGetMacro(Precision, int);
  void SetPrecisionToDouble() { this->SetPrecision(DOUBLE); }
  void SetPrecisionToMixed() { this->SetPrecision(MIXED); }
  void SetPrecisionToFloat() { this->SetPrecision(FLOAT); }
  ///@}

  ///@{
  /**
   * How the system is solved: factored (default), or iteratively, in double precision to a residual of
   * 1e-9 of each right-hand side: cheaper where few columns of a large surface are wanted. The condition
   * number is not estimated then.
   */
  enum SolverType
  {
    DIRECT = 0,
    ITERATIVE = 1
  };
  vtkSetClampMacro(Solver, int, DIRECT, ITERATIVE);
  vtkGetMacro(Solver, int);
  void SetSolverToDirect() { this->SetSolver(DIRECT); }
  void SetSolverToIterative() { this->SetSolver(ITERATIVE); }
  ///@}

  ///@{
  /**
   * Where the boundary integral equation is enforced: averaged under each vertex's hat (default, several
   * times more accurate), or at the vertices alone as in the paper (a third of the integration).
   */
  enum CollocationType
  {
    AVERAGED = 0,
    VERTEX = 1
  };
  vtkSetClampMacro(Collocation, int, AVERAGED, VERTEX);
  vtkGetMacro(Collocation, int);
  void SetCollocationToAveraged() { this->SetCollocation(AVERAGED); }
  void SetCollocationToVertex() { this->SetCollocation(VERTEX); }
  ///@}

  ///@{
  /**
   * The material fills the inside of the surface (default), or the infinite space outside it; then a
   * support is not needed and BoundaryType may be missing (all free). Or it fills the inside of bodies
   * that nothing holds (palpate::removeRigidMotions): BoundaryType is not read, loads are balanced by
   * tractions over the whole surface, and displacements counted from the body's mean motion.
   */
  enum DomainType
  {
    INTERIOR = 0,
    EXTERIOR = 1,
    UNSUPPORTED = 2
  };
  vtkSetClampMacro(Domain, int, INTERIOR, UNSUPPORTED);
  vtkGetMacro(Domain, int);
  void SetDomainToInterior() { this->SetDomain(INTERIOR); }
  void SetDomainToExterior() { this->SetDomain(EXTERIOR); }
  void SetDomainToUnsupported() { this->SetDomain(UNSUPPORTED); }
  ///@}

  ///@{
  /**
   * Relative tolerance to which each boundary integral equation is integrated, 0 to below 1. Default
   * 1e-6, which costs less than the discretisation error of any mesh.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Give the support smooth patches of its own, so that its traction ends at its rim and not half an edge
   * beyond: contacts near it, and what the body does as a whole, become several times more accurate.
   * Default off, the paper's one traction a vertex.
   */
  vtkSetMacro(SupportPatch, bool);
  vtkGetMacro(SupportPatch, bool);
  vtkBooleanMacro(SupportPatch, bool);
  ///@}

  ///@{
  /**
   * Estimate the relative error (palpate::estimateError) on a coarser mesh, for 5 to 20 % of the time, or
   * below 200 vertices on a finer one, for a second or two. Default on.
   */
  vtkSetMacro(EstimateError, bool);
  vtkGetMacro(EstimateError, bool);
  vtkBooleanMacro(EstimateError, bool);
  ///@}

protected:
  vtkBoundaryElementGreensFunctions() = default;
  ~vtkBoundaryElementGreensFunctions() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

  /**
   * The settings for the core, for a surface of so many vertices.
   */
  palpate::BoundaryElementOptions OptionsFor(vtkIdType vertexCount) const;

  /**
   * The model of a surface.
   */
  palpate::ElasticModel ModelOf(vtkPolyData* surface) const;

private:
  vtkBoundaryElementGreensFunctions(const vtkBoundaryElementGreensFunctions&) = delete;
  void operator=(const vtkBoundaryElementGreensFunctions&) = delete;

  int Precision = DOUBLE;
  int Solver = DIRECT;
  int Collocation = AVERAGED;
  int Domain = INTERIOR;
  double Tolerance = 1e-6;
  bool SupportPatch = false;
  bool EstimateError = true;
};

#endif
