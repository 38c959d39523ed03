// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkBoundaryElementGreensFunctions
 * @brief computes the Green's functions of an elastic surface by boundary elements
 *
 * The input is a closed triangle surface with the point array `BoundaryType` and the field data
 * `YoungsModulus` and `PoissonRatio` (vtkReferenceBoundaryConditions). The output carries, besides, the
 * field arrays `GreensFunctions`, `GreensFunctionNodes`, provenance and diagnostics (array_names.h),
 * and is all that the other filters need: it can be written to a .vtp file and read again. Where only
 * Young's modulus has changed since the last execution, the same arrays are handed on: they hold for
 * `GreensFunctionYoungsModulus`, and who uses them scales them to `YoungsModulus`.
 *
 * Method: collocation of the boundary integral equation with linear displacements and tractions on
 * flat triangles; D. L. James and D. K. Pai, "A unified treatment of elastostatic contact simulation
 * for real time haptics", Haptics-e 2(1), 2001, sections 3.3 to 3.6.
 */

#ifndef vtkBoundaryElementGreensFunctions_h
#define vtkBoundaryElementGreensFunctions_h

#include "vtkElastostaticAlgorithm.h"
#include "vtkSmartPointer.h" // for the columns

#include <memory> // for what was computed

class vtkIdTypeArray;
namespace palpate
{
struct BoundaryElementOptions;
class ElasticModel;
}

class PALPATEELASTOSTATICS_EXPORT vtkBoundaryElementGreensFunctions : public vtkElastostaticAlgorithm
{
public:
  static vtkBoundaryElementGreensFunctions* New();
  vtkTypeMacro(vtkBoundaryElementGreensFunctions, vtkElastostaticAlgorithm);
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
   * support is not needed and BoundaryType may be missing (all free).
   */
  enum DomainType
  {
    INTERIOR = 0,
    EXTERIOR = 1
  };
  vtkSetClampMacro(Domain, int, INTERIOR, EXTERIOR);
  vtkGetMacro(Domain, int);
  void SetDomainToInterior() { this->SetDomain(INTERIOR); }
  void SetDomainToExterior() { this->SetDomain(EXTERIOR); }
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
   * Traction may jump across edges whose triangles' normals differ by more than this angle (degrees,
   * default 30), unless the input has a cell array `SmoothPatch`. 180 gives one traction a vertex, as
   * in the paper.
   */
  vtkSetMacro(SmoothAngle, double);
  vtkGetMacro(SmoothAngle, double);
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

  ///@{
  /**
   * Symmetrise the force compliance between free nodes, so that all that is served comes from one
   * energy. Default on; off gives the raw discretisation.
   */
  vtkSetMacro(Reciprocal, bool);
  vtkGetMacro(Reciprocal, bool);
  vtkBooleanMacro(Reciprocal, bool);
  ///@}

  ///@{
  /**
   * Also compute the responses to tractions on single patches of vertices on sharp edges, which
   * vtkCapacitanceSolve needs for tractions given on triangles. Default off.
   */
  vtkSetMacro(PatchColumns, bool);
  vtkGetMacro(PatchColumns, bool);
  vtkBooleanMacro(PatchColumns, bool);
  ///@}

  ///@{
  /**
   * Nodes whose Green's functions are computed; null, the default, for all free nodes.
   */
  virtual void SetColumnNodes(vtkIdTypeArray* nodes);
  vtkIdTypeArray* GetColumnNodes();
  ///@}

  ///@{
  /**
   * Number of threads; 0, the default, for all cores.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkBoundaryElementGreensFunctions();
  ~vtkBoundaryElementGreensFunctions() override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

  /**
   * The settings for the core, for a surface of so many vertices.
   */
  palpate::BoundaryElementOptions OptionsFor(vtkIdType vertexCount) const;

  /**
   * The model of a surface, and a mark on the output of whether the surface's smooth patches were given
   * or found.
   */
  palpate::ElasticModel ModelOf(vtkPolyData* surface) const;
  void MarkPatches(
    vtkPolyData* surface, const palpate::ElasticModel& model, vtkPolyData* output) const;

private:
  struct Computed;

  vtkBoundaryElementGreensFunctions(const vtkBoundaryElementGreensFunctions&) = delete;
  void operator=(const vtkBoundaryElementGreensFunctions&) = delete;

  int Precision = DOUBLE;
  int Solver = DIRECT;
  int Collocation = AVERAGED;
  int Domain = INTERIOR;
  double Tolerance = 1e-6;
  double SmoothAngle = 30;
  bool SupportPatch = false;
  bool EstimateError = true;
  bool Reciprocal = true;
  bool PatchColumns = false;
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkIdTypeArray> ColumnNodes;
  std::unique_ptr<Computed> Kept;
};

#endif
