// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkGreensFunctionsAlgorithm
 * @brief what the filters that compute Green's functions have in common, whatever the method
 *
 * Such a filter keeps what it has computed. Where only Young's modulus has changed since the last
 * execution, the same arrays are handed on: they hold for `GreensFunctionYoungsModulus`, and who uses
 * them scales them to `YoungsModulus`.
 */

#ifndef vtkGreensFunctionsAlgorithm_h
#define vtkGreensFunctionsAlgorithm_h

#include "vtkElastostaticAlgorithm.h"
#include "vtkSmartPointer.h" // for the columns and what was computed

#include <cstdint>    // for fingerprints
#include <functional> // for computations
#include <vector>     // for columns

class vtkIdTypeArray;
namespace palpate
{
class ElasticModel;
}

class PALPATEELASTOSTATICS_EXPORT vtkGreensFunctionsAlgorithm : public vtkElastostaticAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkGreensFunctionsAlgorithm, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
  vtkGreensFunctionsAlgorithm();
  ~vtkGreensFunctionsAlgorithm() override;

  /**
   * Arrays as palpate::convert::setGreensFunctions adds them: those kept, if they are of a model of this
   * fingerprint, and of this filter as it is set; else, for good, those that `compute` adds to the empty
   * surface that it is given. If it throws, none are kept.
   */
  vtkPolyData* Kept(std::uint64_t fingerprint, const std::function<void(vtkPolyData*)>& compute);

  /**
   * ColumnNodes as the core takes them, for a surface of so many vertices: none for all free nodes.
   */
  std::vector<int> Columns(vtkIdType vertexCount) const;

  /**
   * A mark on the output of whether the surface's smooth patches were given or found.
   */
  void MarkPatches(
    vtkPolyData* surface, const palpate::ElasticModel& model, vtkPolyData* output) const;

  double SmoothAngle = 30;
  bool Reciprocal = true;
  bool PatchColumns = false;
  int NumberOfThreads = 0;

private:
  vtkGreensFunctionsAlgorithm(const vtkGreensFunctionsAlgorithm&) = delete;
  void operator=(const vtkGreensFunctionsAlgorithm&) = delete;

  vtkSmartPointer<vtkIdTypeArray> ColumnNodes;
  vtkSmartPointer<vtkPolyData> KeptArrays; // null if none are kept
  std::uint64_t KeptFingerprint = 0;
  vtkMTimeType KeptTime = 0; // of the filter's settings
};

#endif
