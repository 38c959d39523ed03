// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkRigSimulation
 * @brief displacements that a rig would measure on a body: data to try identification on
 *
 * The input is a surface with Green's functions, the "real" body: of another method or a finer mesh than
 * what will be identified. Probes press at places far from each other, markers are looked at anywhere on
 * the free surface; noise, outliers, missing markers, a yielding support and a frame of the rig's own are
 * added as asked for (palpate::simulateMeasurements).
 *
 * The output is the surface, without its Green's functions, with the table of measurements as field data
 * (see array_names.h, `MeasurementProbe` and on), in the rig's frame.
 */

#ifndef vtkRigSimulation_h
#define vtkRigSimulation_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkRigSimulation : public vtkElastostaticAlgorithm
{
public:
  static vtkRigSimulation* New();
  vtkTypeMacro(vtkRigSimulation, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many probes press (5), and how many markers are seen under each (50).
   */
  vtkSetMacro(NumberOfProbes, int);
  vtkGetMacro(NumberOfProbes, int);
  vtkSetMacro(NumberOfMarkers, int);
  vtkGetMacro(NumberOfMarkers, int);
  ///@}

  ///@{
  /**
   * Radius of the probes' tip, m, over which a linear mask spreads the force; 0, the default, for two mean
   * edges of the input.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Size of the forces, N; 0, the default, so that the largest displacement is 1 % of the diagonal. They
   * are tilted from the normal by up to so many degrees (45).
   */
  vtkSetMacro(Force, double);
  vtkGetMacro(Force, double);
  vtkSetMacro(Tilt, double);
  vtkGetMacro(Tilt, double);
  ///@}

  ///@{
  /**
   * Standard deviation of noise over the largest displacement (0.01), whether the table tells it (off), and
   * shares of outliers and of missing displacements (0).
   */
  vtkSetMacro(Noise, double);
  vtkGetMacro(Noise, double);
  vtkSetMacro(WithDeviations, bool);
  vtkGetMacro(WithDeviations, bool);
  vtkBooleanMacro(WithDeviations, bool);

  /// Standard deviation of markers' and contacts' places as the table tells them, each axis, m; 0 by
  /// default.
  vtkSetMacro(PlaceNoise, double);
  vtkGetMacro(PlaceNoise, double);
  vtkSetMacro(Outliers, double);
  vtkGetMacro(Outliers, double);
  vtkSetMacro(Missing, double);
  vtkGetMacro(Missing, double);
  ///@}

  ///@{
  /**
   * The rig's frame: the surface is turned by a vector of degrees, then moved, m.
   */
  vtkSetVector3Macro(Rotation, double);
  vtkGetVector3Macro(Rotation, double);
  vtkSetVector3Macro(Translation, double);
  vtkGetVector3Macro(Translation, double);
  ///@}

  ///@{
  /**
   * Young's modulus over the stiffness per area of an elastic foundation at the support, m; 0, the default,
   * for a firm one. Others need the Green's functions of the fixed vertices.
   */
  vtkSetMacro(SupportYieldLength, double);
  vtkGetMacro(SupportYieldLength, double);
  ///@}

  ///@{
  /**
   * Seed of all that is random. Default 1.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

protected:
  vtkRigSimulation() = default;
  ~vtkRigSimulation() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkRigSimulation(const vtkRigSimulation&) = delete;
  void operator=(const vtkRigSimulation&) = delete;

  int NumberOfProbes = 5, NumberOfMarkers = 50, Seed = 1;
  double Radius = 0, Force = 0, Tilt = 45, Noise = 0.01, Outliers = 0, Missing = 0;
  double SupportYieldLength = 0;
  double Rotation[3] = { 0, 0, 0 }, Translation[3] = { 0, 0, 0 };
  bool WithDeviations = false;
  double PlaceNoise = 0;
};

#endif
