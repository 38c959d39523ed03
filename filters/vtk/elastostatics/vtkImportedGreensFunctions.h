// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkImportedGreensFunctions
 * @brief Green's functions from a compliance or stiffness matrix that somebody else made
 *
 * The input is a triangle surface, closed or with rims, whose vertices are nodes of the matrix; its point
 * array `BoundaryType`, if it has one, says which are fixed. The matrix comes from a file (NumPy, text,
 * Matrix Market, Harwell-Boeing, NASTRAN's DMIG: see palpate::readMatrixFile) or from an array.
 *
 * A stiffness is condensed to the surface's vertices (Guyan 1965), fixed vertices are held, and the rest
 * is inverted. Reactions of fixed vertices are exact. Vertices that are fixed but that the matrix does
 * not have are held where it is from: they do not move, and as their reactions are not known they are
 * free in the output, without a Green's function (palpate::importGreensFunctions).
 *
 * The output carries the same arrays as that of vtkBoundaryElementGreensFunctions, with the
 * `GreensFunctionDomain` "given". Its `YoungsModulus`, by which it can be scaled, and `PoissonRatio` take
 * the place of the input's: the matrix says nothing of them. Checks of shape, symmetry, definiteness,
 * rigid motions and units end in an error of one sentence, or in `Warnings`.
 */

#ifndef vtkImportedGreensFunctions_h
#define vtkImportedGreensFunctions_h

#include "vtkGreensFunctionsAlgorithm.h"

#include <string> // for names

class vtkDoubleArray;

class PALPATEELASTOSTATICS_EXPORT vtkImportedGreensFunctions : public vtkGreensFunctionsAlgorithm
{
public:
  static vtkImportedGreensFunctions* New();
  vtkTypeMacro(vtkImportedGreensFunctions, vtkGreensFunctionsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What the matrix gives: displacements per force (default), or forces per displacement.
   */
  enum KindType
  {
    COMPLIANCE = 0,
    STIFFNESS = 1
  };
  vtkSetClampMacro(Kind, int, COMPLIANCE, STIFFNESS);
  vtkGetMacro(Kind, int);
  void SetKindToCompliance() { this->SetKind(COMPLIANCE); }
  void SetKindToStiffness() { this->SetKind(STIFFNESS); }
  ///@}

  ///@{
  /**
   * The file of the matrix; of the places of its nodes (columns x, y, z, or number, x, y, z, or GRID
   * cards); and of what its rows are, as Ansys' HBMAT writes it. Files are read when the filter executes.
   * Without places the matrix' own are taken, or its nodes are the vertices in their order.
   */
  void SetMatrixFileName(const char* name);
  const char* GetMatrixFileName() const { return this->MatrixFileName.c_str(); }
  void SetNodeFileName(const char* name);
  const char* GetNodeFileName() const { return this->NodeFileName.c_str(); }
  void SetMappingFileName(const char* name);
  const char* GetMappingFileName() const { return this->MappingFileName.c_str(); }
  ///@}

  ///@{
  /**
   * Which of several DMIG matrices; by default the only one, or the only one whose name begins with K.
   */
  void SetMatrixName(const char* name);
  const char* GetMatrixName() const { return this->MatrixName.c_str(); }
  ///@}

  ///@{
  /**
   * Instead of files: a matrix, a row a tuple; nodes, three or four components a tuple.
   */
  virtual void SetMatrix(vtkDoubleArray* matrix);
  virtual void SetNodes(vtkDoubleArray* nodes);
  ///@}

  ///@{
  /**
   * Order of rows where the matrix does not say: x, y, z of each node (default), or all x, all y, all z.
   */
  enum DofOrderType
  {
    BY_NODE = 0,
    BY_COMPONENT = 1
  };
  vtkSetClampMacro(DofOrder, int, BY_NODE, BY_COMPONENT);
  vtkGetMacro(DofOrder, int);
  ///@}

  ///@{
  /**
   * Units of the matrix and of its nodes, the surface's being metres: "m" (default), "cm", "mm", "um",
   * "in", "ft"; "N" (default), "mN", "kN", "MN", "lbf", "kgf".
   */
  void SetLengthUnit(const char* unit);
  const char* GetLengthUnit() const { return this->LengthUnit.c_str(); }
  void SetForceUnit(const char* unit);
  const char* GetForceUnit() const { return this->ForceUnit.c_str(); }
  ///@}

  ///@{
  /**
   * How near a node is to the vertex that it is, over the surface's diagonal. Default 1e-5.
   */
  vtkSetMacro(NodeTolerance, double);
  vtkGetMacro(NodeTolerance, double);
  ///@}

  ///@{
  /**
   * Young's modulus that the matrix holds for, Pa; 0, the default, for that of a body of the surface's
   * size and compliance. Nothing but scaling depends on it.
   */
  vtkSetMacro(YoungsModulus, double);
  vtkGetMacro(YoungsModulus, double);
  ///@}

  ///@{
  /**
   * A loose body's stiffness is one of a body that nothing holds, as Domain UNSUPPORTED of
   * vtkBoundaryElementGreensFunctions. Default off, where fixed vertices have to hold it.
   */
  vtkSetMacro(Unsupported, bool);
  vtkGetMacro(Unsupported, bool);
  vtkBooleanMacro(Unsupported, bool);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkImportedGreensFunctions();
  ~vtkImportedGreensFunctions() override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkImportedGreensFunctions(const vtkImportedGreensFunctions&) = delete;
  void operator=(const vtkImportedGreensFunctions&) = delete;

  int Kind = COMPLIANCE;
  int DofOrder = BY_NODE;
  double NodeTolerance = 1e-5;
  double YoungsModulus = 0;
  bool Unsupported = false;
  std::string MatrixFileName, NodeFileName, MappingFileName, MatrixName;
  std::string LengthUnit = "m", ForceUnit = "N";
  vtkSmartPointer<vtkDoubleArray> Matrix, Nodes;
};

#endif
