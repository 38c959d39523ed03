// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkCapacitanceSolve
 * @brief solves for contacts by the capacitance matrix
 *
 * Input 0: a surface with its Green's functions. Input 1: the constraints, a tuple each in the point
 * data of a point set or the row data of a table:
 * - `Node` (id): the vertex, by its number;
 * - `Displacement` (3, m): prescribed at a free vertex (contact) or as the movement of a fixed one;
 * - `Traction` (3, Pa): prescribed at a free vertex (load) or at a fixed one that is released;
 * - `BoundaryType` (optional): 1 the displacement is prescribed, 0 the traction. Default 1;
 * - `Direction` (3, optional): only the component along this vector is switched, as in frictionless
 *   contact; zero for the whole vector. No two at a vertex may be the same, and what moves a fixed or
 *   loads a free one must be at right angles;
 * - `SpringStiffness` (N/m, optional): the displacement is not the vertex's but that of the far end of a
 *   spring of this stiffness that holds it; 0 for none. A fixed vertex is released onto its spring. Not
 *   with a prescribed traction;
 * - `Zone` (int, optional): the contact that the vertex belongs to; default 0.
 *
 * Output: the surface with `Displacement` and `Traction` at all vertices, and the field arrays
 * `ContactForce` and `ContactTorque` (about the centroid of the zone's vertices), a tuple a zone, over
 * all vertices of the zone whose displacement is prescribed, and `ContactCondition`, the condition
 * number of the capacitance matrix. Forces are vertex area times traction (eq. 27). Those of contacts
 * act at the vertices, so that their torque is conjugate to turning the vertices; reactions of the
 * support act where its tractions do, so that they balance the loads. D. L. James and D. K. Pai 2001,
 * sections 4 and 5. Inverses of the last constraint sets are kept while the input stays.
 */

#ifndef vtkCapacitanceSolve_h
#define vtkCapacitanceSolve_h

#include "vtkElastostaticAlgorithm.h"

#include <memory> // for the solver
#include <string> // for the array's name

class PALPATEELASTOSTATICS_EXPORT vtkCapacitanceSolve : public vtkElastostaticAlgorithm
{
public:
  static vtkCapacitanceSolve* New();
  vtkTypeMacro(vtkCapacitanceSolve, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The constraints. Without them the reference problem itself is solved.
   */
  void SetConstraintsConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetConstraintsData(vtkDataObject* constraints) { this->SetInputData(1, constraints); }

  /**
   * Name of a cell array of the surface with tractions (3, Pa) on its triangles, which may jump across
   * sharp edges; loaded vertices there need Green's functions computed with PatchColumns. Empty for
   * none.
   */
  void SetTriangleTractionArrayName(const char* name);
  const char* GetTriangleTractionArrayName() const { return this->TriangleTractionArrayName.c_str(); }

protected:
  vtkCapacitanceSolve();
  ~vtkCapacitanceSolve() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkCapacitanceSolve(const vtkCapacitanceSolve&) = delete;
  void operator=(const vtkCapacitanceSolve&) = delete;

  struct Prepared;
  Prepared& Prepare(vtkPolyData* input);

  std::string TriangleTractionArrayName;
  std::unique_ptr<Prepared> Kept;
};

#endif
