// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/solid_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "mesh/mesh_defects.h"
#include "sentence.h"

namespace palpate {
namespace {

/// The point of the mesh at each vertex of the surface.
std::vector<int> pointsAt(const SurfaceMesh& surface, const TetrahedralMesh& mesh) {
  Eigen::Matrix3Xd all(3, mesh.pointCount() + surface.vertexCount());
  all << mesh.points(), surface.points();
  const std::vector<int> nearest = nearestDuplicates(all, kDuplicateDistance * surface.diagonal());
  std::vector<int> points(nearest.begin() + mesh.pointCount(), nearest.end());
  for (int v = 0; v < surface.vertexCount(); ++v)
    if (points[v] >= mesh.pointCount())
      refuse("vertex ", v, " of the surface is no point of the volume mesh");
  return points;
}

/// The same for each triangle with these corners in this sense of rotation.
std::array<int, 3> fromLowest(std::array<int, 3> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

SolidBody::SolidBody(const SurfaceMesh& surface, TetrahedralMesh mesh,
                     std::vector<Elasticity> materials, std::vector<int> materialOfCell,
                     Eigen::VectorXd densities)
    : mesh_(std::move(mesh)),
      materials_(std::move(materials)),
      materialOfCell_(std::move(materialOfCell)),
      pointOfVertex_(pointsAt(surface, mesh_)),
      densities_(std::move(densities)) {
  const std::size_t numbers = materialOfCell_.size();
  if (materials_.empty() || (numbers != 0 && numbers != std::size_t(mesh_.cellCount())) ||
      (numbers == 0 && materials_.size() > 1))
    refuse("there are ", materials_.size(), " materials, and their numbers of ", numbers, " of ",
           mesh_.cellCount(), " tetrahedra");
  for (std::size_t cell = 0; cell < numbers; ++cell)
    if (materialOfCell_[cell] < 0 || materialOfCell_[cell] >= materialCount())
      refuse("tetrahedron ", cell, " has no material");
  requireBoundary(surface);
  if (densities_.size() > 0) weigh();
}

void SolidBody::weigh() {
  if (densities_.size() != mesh_.cellCount())
    refuse("there are ", densities_.size(), " densities for ", mesh_.cellCount(), " tetrahedra");
  double mass = 0, volume = 0;
  for (int cell = 0; cell < mesh_.cellCount(); ++cell) {
    if (!(densities_[cell] > 0 && std::isfinite(densities_[cell])))
      refuse("the density of tetrahedron ", cell, " must be positive, not ", densities_[cell]);
    const double part = mesh_.volumes()[cell];
    mass += densities_[cell] * part;
    volume += part;
  }
  density_ = mass / volume;
}

void SolidBody::requireBoundary(const SurfaceMesh& surface) const {
  std::set<std::array<int, 3>> boundary;
  for (const auto& triangle : mesh_.boundary().colwise())
    boundary.insert(fromLowest({triangle[0], triangle[1], triangle[2]}));
  for (int f = 0; f < surface.triangleCount(); ++f) {
    const auto corner = [&](int k) { return pointOfVertex_[surface.triangles()(k, f)]; };
    if (boundary.count(fromLowest({corner(0), corner(1), corner(2)})) == 0)
      refuse("triangle ", f, " of the surface is not on the boundary of the volume mesh");
  }
  if (static_cast<std::size_t>(surface.triangleCount()) != boundary.size())
    refuse("the surface has ", surface.triangleCount(),
           " triangles, the boundary of the volume mesh ", boundary.size());
}

std::vector<Elasticity> SolidBody::materialsBehind(const SurfaceMesh& surface) const {
  const auto sorted = [](std::array<int, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::map<std::array<int, 3>, int>
      cellOf;  // of one face of two cells either, which is asked of none
  for (int cell = 0; cell < mesh_.cellCount(); ++cell)
    for (int left = 0; left < 4; ++left) {
      const auto corner = [&](int k) { return mesh_.tetrahedra()((left + k) % 4, cell); };
      cellOf[sorted({corner(1), corner(2), corner(3)})] = cell;
    }
  std::vector<Elasticity> materials;
  for (int f = 0; f < surface.triangleCount(); ++f) {
    const auto point = [&](int k) { return pointOfVertex_[surface.triangles()(k, f)]; };
    materials.push_back(material(cellOf.at(sorted({point(0), point(1), point(2)}))));
  }
  return materials;
}

bool SolidBody::isOf(const Material& material) const {
  const Elasticity isotropic(material);
  return materialCount() == 1 && materials_[0].isSplit() == isotropic.isSplit() &&
         materials_[0].compressibility() == isotropic.compressibility() &&
         materials_[0].stiffness() == isotropic.stiffness();
}

double SolidBody::largestStiffness() const {
  double largest = 0;
  for (const Elasticity& material : materials_)
    largest = std::max(largest, material.stiffness().cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace palpate
