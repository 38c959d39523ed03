// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkInteriorProbe
 * @brief displacement, strain and stress inside a pressed body
 *
 * Input 0: a model with `Displacement` and `Traction` at its points, as vtkPointContact and
 * vtkCapacitanceSolve leave them, of one isotropic material, whatever method computed it, or of several or
 * anisotropic ones with probes at these places (vtkFiniteElementGreensFunctions::AddProbe). Input 1: the
 * places to probe, any point set. Output: those points (with the cells of polydata, as vertices of
 * others) and the point arrays `Displacement` (m), `Strain` and `Stress` (six components: xx, yy, zz, xy,
 * yz, xz; Pa), `VonMisesStress`, `PrincipalStress` (three, the largest first; Pa), `InsideMaterial` (1, or
 * 0 with zeros in the other arrays) and `EdgesFromSurface`, the distance in mean edges: nearer than about
 * one, strains show the kinks of the surface's.
 *
 * Method: Somigliana's identity and its derivatives over the surface, integrated adaptively near it
 * (palpate::InteriorProbes; D. L. James and D. K. Pai 2001, section 3.5). The integrals are kept while
 * body and points stay, so that pressing elsewhere costs 78 products a vertex and point. A probe that the
 * model carries is read as a row of its Green's functions: its field is the elements', and gradients jump
 * between them.
 */

#ifndef vtkInteriorProbe_h
#define vtkInteriorProbe_h

#include "vtkElastostaticAlgorithm.h"

#include <memory> // for what is kept

class PALPATEELASTOSTATICS_EXPORT vtkInteriorProbe : public vtkElastostaticAlgorithm
{
public:
  static vtkInteriorProbe* New();
  vtkTypeMacro(vtkInteriorProbe, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The places to probe.
   */
  void SetProbeConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetProbeData(vtkDataObject* points) { this->SetInputData(1, points); }
  ///@}

  ///@{
  /**
   * Number of threads; 0, the default, for all cores.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

protected:
  vtkInteriorProbe();
  ~vtkInteriorProbe() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkInteriorProbe(const vtkInteriorProbe&) = delete;
  void operator=(const vtkInteriorProbe&) = delete;

  struct Prepared;
  int NumberOfThreads = 0;
  std::unique_ptr<Prepared> Kept;
};

#endif
