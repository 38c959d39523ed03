// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkMaskedContactAlgorithm
 * @brief the pressure mask's settings, for the filters that use one
 *
 * A vertex pressure mask spreads a point-like force over the free nodes around a vertex, so that the
 * contact has a size of its own, whatever the mesh (James & Pai 2001, section 6.1). A radius below the
 * edge length, such as the default 0, is the single vertex. A mask holds free vertices of one component
 * and one side of a wall only; at the support it is cut off, and transmits the whole force all the same.
 */

#ifndef vtkMaskedContactAlgorithm_h
#define vtkMaskedContactAlgorithm_h

#include "vtkElastostaticAlgorithm.h"

namespace palpate
{
struct MaskSettings;
}

class PALPATEELASTOSTATICS_EXPORT vtkMaskedContactAlgorithm : public vtkElastostaticAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkMaskedContactAlgorithm, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How the pressure falls with distance over radius, t: linear 1 - t (default, the paper's); uniform;
   * gaussian exp(-(3t)^2/2); hertzian sqrt(1 - t^2). Or the smooth pressure nearest to a point load
   * (appendix A), with the gradient penalised, or the biharmonic, which also pulls a little; these need
   * a radius, and sink the centre of a contact as deep as the linear mask of that radius does.
   */
  enum MaskType
  {
    LINEAR = 0,
    UNIFORM = 1,
    GAUSSIAN = 2,
    HERTZIAN = 3,
    GRADIENT = 4,
    BIHARMONIC = 5
  };
  vtkSetClampMacro(Mask, int, LINEAR, BIHARMONIC);
  vtkGetMacro(Mask, int);
  void SetMaskToLinear() { this->SetMask(LINEAR); }
  void SetMaskToUniform() { this->SetMask(UNIFORM); }
  void SetMaskToGaussian() { this->SetMask(GAUSSIAN); }
  void SetMaskToHertzian() { this->SetMask(HERTZIAN); }
  void SetMaskToGradient() { this->SetMask(GRADIENT); }
  void SetMaskToBiharmonic() { this->SetMask(BIHARMONIC); }
  ///@}

  ///@{
  /**
   * The distance that t is made of: straight (euclidean, default), or along the surface (geodesic, by
   * CGAL's heat method), so that a mask does not reach across a groove. Gradient and biharmonic masks
   * are along the surface anyway.
   */
  enum DistanceType
  {
    EUCLIDEAN = 0,
    GEODESIC = 1
  };
  vtkSetClampMacro(Distance, int, EUCLIDEAN, GEODESIC);
  vtkGetMacro(Distance, int);
  void SetDistanceToEuclidean() { this->SetDistance(EUCLIDEAN); }
  void SetDistanceToGeodesic() { this->SetDistance(GEODESIC); }
  ///@}

  ///@{
  /**
   * Radius of the mask, >= 0, in the unit of the points or in mean edge lengths. Default 0.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  vtkSetMacro(RadiusInEdgeLengths, bool);
  vtkGetMacro(RadiusInEdgeLengths, bool);
  vtkBooleanMacro(RadiusInEdgeLengths, bool);
  ///@}

protected:
  vtkMaskedContactAlgorithm() = default;
  ~vtkMaskedContactAlgorithm() override = default;

  /**
   * The mask, with the radius in the unit of the points.
   */
  palpate::MaskSettings Settings(double meanEdgeLength) const;

  int Mask = LINEAR;
  int Distance = EUCLIDEAN;
  double Radius = 0;
  bool RadiusInEdgeLengths = false;

private:
  vtkMaskedContactAlgorithm(const vtkMaskedContactAlgorithm&) = delete;
  void operator=(const vtkMaskedContactAlgorithm&) = delete;
};

#endif
