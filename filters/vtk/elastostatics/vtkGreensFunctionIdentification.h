// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkGreensFunctionIdentification
 * @brief a body's material, and with it its Green's functions, from measured displacements
 *
 * Input 0 is a closed triangle surface with the point array `BoundaryType` (vtkReferenceBoundaryConditions
 * with RequireMaterial off; where the surface has a Young's modulus that differs a hundredfold from the one
 * identified, that is a warning). Input 1 is optional, for finite elements: an unstructured grid of
 * tetrahedra whose boundary the surface is; its cell array `MaterialRegion` (int from 0) says which of them
 * have a Young's modulus of their own. Without it the surface is filled with tetrahedra, and replaced by
 * their boundary where that has other triangles, with a warning. The measurements are a file
 * (palpate::readMeasurementFile), or input 2: polydata with the table as field data (see array_names.h,
 * `MeasurementProbe` and on).
 *
 * Young's modulus is identified always, Poisson's ratio unless it is given, the yielding of the support
 * and the rigid registration of the measurements to the surface if asked for. Method: robust least squares
 * by Ceres on responses that are exactly proportional to 1 / E and interpolated in the rest
 * (palpate::MaterialIdentifier). What the data do not determine ends in an error that names it, and the
 * probe that would help.
 *
 * The output is the surface with the Green's functions of the identified material, as those that compute
 * them give it, and with the arrays of array_names.h: values, standard deviations, intervals and
 * correlations, residuals, outliers, the error of probes left out. `Warnings` has what is doubtful.
 */

#ifndef vtkGreensFunctionIdentification_h
#define vtkGreensFunctionIdentification_h

#include "vtkGreensFunctionsAlgorithm.h"

#include <limits>   // for what is not given
#include <optional> // for registrations
#include <string>   // for names

class vtkUnstructuredGrid;
namespace palpate
{
struct IdentificationOptions;
struct MaterialIdentification;
struct MaterialUnknowns;
struct Measurements;
struct Registration;
struct ComputedGreensFunctions;
class MaterialIdentifier;
class Progress;
class SurfaceMesh;
}

class PALPATEELASTOSTATICS_EXPORT vtkGreensFunctionIdentification : public vtkGreensFunctionsAlgorithm
{
public:
  static vtkGreensFunctionIdentification* New();
  vtkTypeMacro(vtkGreensFunctionIdentification, vtkGreensFunctionsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How Green's functions are computed: boundary elements (default) or finite elements.
   */
  enum MethodType
  {
    BOUNDARY_ELEMENTS = 0,
    FINITE_ELEMENTS = 1
  };
  vtkSetClampMacro(Method, int, BOUNDARY_ELEMENTS, FINITE_ELEMENTS);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * The table of measurements, in these units of length and force (as vtkImportedGreensFunctions has them);
   * without a file input 2 is taken. The file is read when the filter executes.
   */
  void SetMeasurementFileName(const char* name);
  const char* GetMeasurementFileName() const { return this->MeasurementFileName.c_str(); }
  void SetLengthUnit(const char* unit);
  const char* GetLengthUnit() const { return this->LengthUnit.c_str(); }
  void SetForceUnit(const char* unit);
  const char* GetForceUnit() const { return this->ForceUnit.c_str(); }
  ///@}

  ///@{
  /**
   * Poisson's ratio where it is known; NaN, the default, to identify it in PoissonRange: by default from 0
   * to 0.499, for finite elements to 0.449, up to which they are of one kind.
   */
  vtkSetMacro(PoissonRatio, double);
  vtkGetMacro(PoissonRatio, double);
  vtkSetVector2Macro(PoissonRange, double);
  vtkGetVector2Macro(PoissonRange, double);
  ///@}

  ///@{
  /**
   * Identify Young's modulus over the stiffness per area of the support, too, as of an elastic foundation.
   * Default off.
   */
  vtkSetMacro(YieldingSupport, bool);
  vtkGetMacro(YieldingSupport, bool);
  vtkBooleanMacro(YieldingSupport, bool);
  ///@}

  ///@{
  /**
   * Register the measurements to the surface by a rigid motion first. Default off.
   */
  vtkSetMacro(Register, bool);
  vtkGetMacro(Register, bool);
  vtkBooleanMacro(Register, bool);
  ///@}

  ///@{
  /**
   * How residuals count while outliers are looked for: all as they are, or by Huber's, Cauchy's (default)
   * or Tukey's loss. Outliers are then left out, and named in the output.
   */
  enum LossType
  {
    NONE = 0,
    HUBER = 1,
    CAUCHY = 2,
    TUKEY = 3
  };
  vtkSetClampMacro(Loss, int, NONE, TUKEY);
  vtkGetMacro(Loss, int);
  ///@}

  ///@{
  /**
   * Largest ratio of two regions' Young's moduli (10); error of interpolated responses, relative (1e-4);
   * folds of the cross-validation by probes (5; 0 for none); and how far a place may be from the surface,
   * over its diagonal (0.02).
   */
  vtkSetMacro(LargestRatio, double);
  vtkGetMacro(LargestRatio, double);
  vtkSetMacro(InterpolationTolerance, double);
  vtkGetMacro(InterpolationTolerance, double);
  vtkSetClampMacro(NumberOfFolds, int, 0, 1000);
  vtkGetMacro(NumberOfFolds, int);
  vtkSetMacro(PlaceTolerance, double);
  vtkGetMacro(PlaceTolerance, double);
  ///@}

  ///@{
  /**
   * Also propose so many further probes, of normal and tilted forces at sixteen places, that would tell most
   * (palpate::chooseProbes), each at another place while there are any. Takes about as long again.
   * Default 0.
   */
  vtkSetClampMacro(NumberOfNextProbes, int, 0, 100);
  vtkGetMacro(NumberOfNextProbes, int);
  ///@}

  ///@{
  /**
   * Estimate the error of the identified model (palpate::estimateError): what the discretisation may add to
   * the standard deviations. Default on; not for several regions.
   */
  vtkSetMacro(EstimateError, bool);
  vtkGetMacro(EstimateError, bool);
  vtkBooleanMacro(EstimateError, bool);
  ///@}

protected:
  vtkGreensFunctionIdentification();
  ~vtkGreensFunctionIdentification() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

  /**
   * The measurements, in the surface's frame.
   */
  palpate::Measurements MeasurementsOn(const palpate::SurfaceMesh& mesh, vtkPolyData* table,
    std::optional<palpate::Registration>& registration);

  /**
   * Poisson's ratio, or where it is looked for.
   */
  palpate::MaterialUnknowns PoissonUnknown(bool isSolid) const;

  /**
   * Says in a model's source what it was identified from, and warns: of another surface, of a Young's
   * modulus far from the input's, and of what the fit warns of.
   */
  void Describe(vtkPolyData* input, const palpate::Measurements& measurements, const std::string& how,
    const palpate::MaterialIdentification& result, const std::string& warning,
    palpate::ComputedGreensFunctions& greens) const;

  int Method = BOUNDARY_ELEMENTS;
  int Loss = CAUCHY;
  int NumberOfFolds = 5;
  int NumberOfNextProbes = 0;
  double PoissonRatio = std::numeric_limits<double>::quiet_NaN();
  double PoissonRange[2] = { PoissonRatio, PoissonRatio };
  double LargestRatio = 10;
  double InterpolationTolerance = 1e-4;
  double PlaceTolerance = 0.02;
  bool YieldingSupport = false;
  bool Register = false;
  bool EstimateError = true;

private:
  vtkGreensFunctionIdentification(const vtkGreensFunctionIdentification&) = delete;
  void operator=(const vtkGreensFunctionIdentification&) = delete;

  struct Body;
  Body BodyOf(
    vtkPolyData* surface, vtkUnstructuredGrid* grid, const palpate::Progress& progress) const;
  palpate::IdentificationOptions OptionsFor(const Body& body) const;
  palpate::MaterialIdentifier IdentifierFor(const Body& body, const palpate::Measurements& measurements,
    const palpate::Progress& progress) const;
  void ProposeProbes(const Body& body, const palpate::MaterialIdentifier& identifier,
    const palpate::Measurements& measurements, const palpate::MaterialIdentification& result,
    vtkPolyData* output, const palpate::Progress& progress) const;

  std::string MeasurementFileName, LengthUnit = "m", ForceUnit = "N";
};

#endif
