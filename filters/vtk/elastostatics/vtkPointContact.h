// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkPointContact
 * @brief presses a surface at a point, by a displacement or by a force
 *
 * The contact is at the point of the surface nearest to Point, anywhere on a triangle. Adds the point
 * arrays `Displacement` and `Traction` and the field arrays `ContactForce` (on the body),
 * `ContactPoint`, `ElasticContactPoint` and `HapticContactPoint` (x^C, x^E and x^H of James & Pai
 * 2001, fig. 8; section 6.3, eq. 34 and 35). Input: a surface with its Green's functions. Moving the
 * point or changing the load costs one evaluation; masks and stiffnesses are kept while the input and
 * the mask stay.
 */

#ifndef vtkPointContact_h
#define vtkPointContact_h

#include "vtkMaskedContactAlgorithm.h"

#include <memory> // for what is kept between executions

class PALPATEELASTOSTATICS_EXPORT vtkPointContact : public vtkMaskedContactAlgorithm
{
public:
  static vtkPointContact* New();
  vtkTypeMacro(vtkPointContact, vtkMaskedContactAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where to press, on or near the undeformed surface.
   */
  vtkSetVector3Macro(Point, double);
  vtkGetVector3Macro(Point, double);
  ///@}

  ///@{
  /**
   * What is prescribed: the displacement of the probe (m), which the force follows by eq. 34 and the
   * contact by eq. 35 (between vertices by less), or the force on the body (N). Setting one
   * chooses it.
   */
  void SetDisplacement(double x, double y, double z);
  void SetDisplacement(const double value[3]) { this->SetDisplacement(value[0], value[1], value[2]); }
  vtkGetVector3Macro(Displacement, double);
  void SetForce(double x, double y, double z);
  void SetForce(const double value[3]) { this->SetForce(value[0], value[1], value[2]); }
  vtkGetVector3Macro(Force, double);
  vtkGetMacro(ForcePrescribed, bool);
  ///@}

  ///@{
  /**
   * k_Rigid (N/m), see vtkSurfaceStiffness. Default 0.
   */
  vtkSetMacro(RigidStiffness, double);
  vtkGetMacro(RigidStiffness, double);
  ///@}

  ///@{
  /**
   * The displacement that the stiffness goes by: that of the vertex itself (default, eq. 32), or the
   * mean under the mask, on which the mask's force does its work.
   */
  enum MeasureType
  {
    VERTEX = 0,
    MEAN = 1
  };
  vtkSetClampMacro(Measure, int, VERTEX, MEAN);
  vtkGetMacro(Measure, int);
  void SetMeasureToVertex() { this->SetMeasure(VERTEX); }
  void SetMeasureToMean() { this->SetMeasure(MEAN); }
  ///@}

  ///@{
  /**
   * A torque on the body (N m) besides, about the mask's centre and spread by the mask (footnote 7). It
   * adds the field arrays `ContactTorque` and `ContactRotation` (the mean under the mask, rad), and needs
   * a mask of three nodes or more. Default 0.
   */
  vtkSetVector3Macro(Torque, double);
  vtkGetVector3Macro(Torque, double);
  ///@}

protected:
  vtkPointContact();
  ~vtkPointContact() override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkPointContact(const vtkPointContact&) = delete;
  void operator=(const vtkPointContact&) = delete;

  struct Prepared;
  const Prepared& Prepare(vtkPolyData* input);

  double Point[3] = { 0, 0, 0 };
  double Displacement[3] = { 0, 0, 0 };
  double Force[3] = { 0, 0, 0 };
  double Torque[3] = { 0, 0, 0 };
  int Measure = VERTEX;
  bool ForcePrescribed = false;
  double RigidStiffness = 0;
  std::unique_ptr<Prepared> Kept;
};

#endif
