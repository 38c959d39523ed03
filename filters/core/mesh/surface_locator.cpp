// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/surface_locator.h"

namespace palpate {

SurfaceLocator::SurfaceLocator(std::shared_ptr<const SurfaceMesh> mesh)
    : mesh_(std::move(mesh)), tree_(mesh_) {}

SurfacePoint SurfaceLocator::nearest(const Eigen::Vector3d& place) const noexcept {
  NearestPoint query(*mesh_, place);
  tree_.ask(query);
  return query.point();
}

std::optional<SurfacePoint> SurfaceLocator::firstEntry(const Eigen::Vector3d& from,
                                                       const Eigen::Vector3d& to) const noexcept {
  if (from == to) return std::nullopt;
  FirstCrossing query(*mesh_, from, to, true);
  tree_.ask(query);
  if (!query.found()) return std::nullopt;
  return query.point();
}

bool SurfaceLocator::isInside(const Eigen::Vector3d& place) const noexcept {
  // What a segment to somewhere within the nearest triangle first meets, it meets from the side
  // that the place is on.
  const int nearest = this->nearest(place).triangle;
  const Eigen::Vector3d target = placeOf(*mesh_, {nearest, Eigen::Vector3d::Constant(1. / 3)});
  if (target == place) return false;
  FirstCrossing query(*mesh_, place, target, false);
  tree_.ask(query);
  if (query.found()) return !query.isEntry();
  return mesh_->triangleNormals().col(nearest).dot(target - place) > 0;
}

}  // namespace palpate
