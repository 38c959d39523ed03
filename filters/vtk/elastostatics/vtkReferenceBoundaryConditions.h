// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkReferenceBoundaryConditions
 * @brief says where a body is fixed and what it is made of
 *
 * Writes the point array `BoundaryType` (0 free, 1 fixed; the reference boundary value problem of James
 * & Pai 2001, section 4.1) and the material as field data. A vertex is fixed if any of the given
 * sources says so: an array, half-spaces, boxes, spheres, an implicit function, a selection (second
 * input, optional). Without any source the input's own BoundaryType array stays. Results of contacts
 * and of stiffness are dropped, as they belong to another problem.
 */

#ifndef vtkReferenceBoundaryConditions_h
#define vtkReferenceBoundaryConditions_h

#include "vtkElastostaticAlgorithm.h"
#include "vtkSmartPointer.h" // for the implicit function

#include <array>  // for the regions
#include <string> // for the array's name
#include <vector> // for the regions

class vtkImplicitFunction;
class vtkSelection;

class PALPATEELASTOSTATICS_EXPORT vtkReferenceBoundaryConditions : public vtkElastostaticAlgorithm
{
public:
  static vtkReferenceBoundaryConditions* New();
  vtkTypeMacro(vtkReferenceBoundaryConditions, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * Young's modulus (Pa, > 0) and Poisson's ratio (-1 < nu <= 0.5). While they are NaN, the default,
   * the input's field data are kept.
   */
  vtkSetMacro(YoungsModulus, double);
  vtkGetMacro(YoungsModulus, double);
  vtkSetMacro(PoissonRatio, double);
  vtkGetMacro(PoissonRatio, double);
  ///@}

  ///@{
  /**
   * Refuse a surface that has no material then. Off where one is to be identified: what there is stays, and
   * is not looked at. Default on.
   */
  vtkSetMacro(RequireMaterial, bool);
  vtkGetMacro(RequireMaterial, bool);
  vtkBooleanMacro(RequireMaterial, bool);
  ///@}

  /**
   * Name of a point array whose vertices are fixed where it is not zero. Empty for none.
   */
  void SetFixedArrayName(const char* name);
  const char* GetFixedArrayName() const { return this->FixedArrayName.c_str(); }

  ///@{
  /**
   * Fixes vertices where (x - origin) . normal <= 0, inside a closed box, or a closed ball.
   */
  void AddFixedHalfSpace(const double origin[3], const double normal[3]);
  void AddFixedBox(const double bounds[6]);
  void AddFixedSphere(const double center[3], double radius);
  void ClearFixedRegions();
  ///@}

  ///@{
  /**
   * Fixes vertices where the function is <= 0.
   */
  virtual void SetFixedFunction(vtkImplicitFunction* function);
  vtkImplicitFunction* GetFixedFunction();
  ///@}

  /**
   * Fixes the selected points, or the points of the selected cells.
   */
  void SetFixedSelectionConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetFixedSelectionData(vtkDataObject* selection) { this->SetInputData(1, selection); }

protected:
  vtkReferenceBoundaryConditions();
  ~vtkReferenceBoundaryConditions() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkReferenceBoundaryConditions(const vtkReferenceBoundaryConditions&) = delete;
  void operator=(const vtkReferenceBoundaryConditions&) = delete;

  bool IsInFixedRegion(const double point[3]) const;
  std::vector<unsigned char> FindFixedPoints(vtkPolyData* surface, vtkSelection* selection) const;

  double YoungsModulus, PoissonRatio;
  bool RequireMaterial = true;
  std::string FixedArrayName;
  std::vector<std::array<double, 6>> HalfSpaces, Boxes;
  std::vector<std::array<double, 4>> Spheres;
  vtkSmartPointer<vtkImplicitFunction> FixedFunction;
};

#endif
