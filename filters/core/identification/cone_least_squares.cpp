// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/cone_least_squares.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>

#include "sentence.h"

namespace palpate {
namespace {

constexpr int kMostRounds = 400;
constexpr int kMostRaysOfLoad = 3;  // span all forces
constexpr double kRidge = 1e-10;    // of columns of length 1: rays of neighbours are almost alike

/// The rays in use, with columns of length 1 and their products.
class ActiveRays {
 public:
  ActiveRays(const ConeLoads& loads, const Eigen::VectorXd& data) : loads_(loads), data_(data) {}

  Eigen::VectorXd residual() const {
    return data_ - columns_.leftCols(count()) * sizes_.head(count());
  }

  /// @return whether it stays when all are settled.
  bool join(int load, const Eigen::Vector3d& direction) {
    add(load, direction, 0);
    settle();
    const bool stays =
        count() > 0 && rays_.back().load == load && rays_.back().direction == direction;
    mergeRaysOf(load);
    return stays;
  }

  std::vector<ConeRay> rays() const {
    std::vector<ConeRay> rays = rays_;
    for (Eigen::Index i = 0; i < count(); ++i) rays[i].size = sizes_[i] / lengths_[i];
    return rays;
  }

 private:
  Eigen::Index count() const { return static_cast<Eigen::Index>(rays_.size()); }

  void add(int load, const Eigen::Vector3d& direction, double size) {
    const Eigen::Index last = count();
    if (last == columns_.cols()) grow();
    const Eigen::VectorXd column = loads_.response.middleCols<3>(3 * load) * direction;
    const double length = column.norm();
    rays_.push_back({load, direction, 0});
    lengths_.push_back(length);
    columns_.col(last) = column / length;
    gram_.row(last).head(last + 1) = columns_.col(last).transpose() * columns_.leftCols(last + 1);
    gram_.col(last).head(last) = gram_.row(last).head(last).transpose();
    gram_(last, last) += kRidge;
    target_[last] = columns_.col(last).dot(data_);
    sizes_[last] = size * length;
  }

  /// Minimises over the sizes of the rays in use; those that reach zero leave.
  void settle() {
    while (count() > 0) {
      const Eigen::Index n = count();
      const Eigen::VectorXd wanted = gram_.topLeftCorner(n, n).llt().solve(target_.head(n));
      Eigen::Index first = -1;
      double step = 1;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (wanted[i] > 0) continue;
        const double here = sizes_[i] / (sizes_[i] - wanted[i]);
        if (first >= 0 && !(here < step)) continue;
        step = here;
        first = i;
      }
      if (first < 0) {
        sizes_.head(n) = wanted;
        return;
      }
      if (step > 0) sizes_.head(n) += step * (wanted - sizes_.head(n));
      remove(first);
    }
  }

  /// Of more than three rays of a load the two nearest each other become one: its force stays.
  void mergeRaysOf(int load) {
    std::vector<Eigen::Index> own;
    for (Eigen::Index i = 0; i < count(); ++i)
      if (rays_[i].load == load) own.push_back(i);
    if (int(own.size()) <= kMostRaysOfLoad) return;
    Eigen::Index first = own[0], second = own[1];
    const auto apart = [&](Eigen::Index a, Eigen::Index b) {
      return (rays_[a].direction - rays_[b].direction).squaredNorm();
    };
    for (std::size_t a = 0; a < own.size(); ++a)
      for (std::size_t b = a + 1; b < own.size(); ++b)
        if (apart(own[a], own[b]) < apart(first, second)) {
          first = own[a];
          second = own[b];
        }
    const double one = sizes_[first] / lengths_[first], other = sizes_[second] / lengths_[second];
    const Eigen::Vector3d between =
        (one * rays_[first].direction + other * rays_[second].direction) / (one + other);
    remove(second);
    remove(first);
    add(load, between, one + other);
  }

  void grow() {
    const Eigen::Index room = 2 * count() + 32;
    columns_.conservativeResize(data_.size(), room);
    gram_.conservativeResize(room, room);
    target_.conservativeResize(room);
    sizes_.conservativeResize(room);
  }

  void remove(Eigen::Index i) {
    const Eigen::Index last = count() - 1;
    rays_.erase(rays_.begin() + i);
    lengths_.erase(lengths_.begin() + i);
    for (Eigen::Index j = i; j < last; ++j) {
      columns_.col(j) = columns_.col(j + 1);
      gram_.col(j) = gram_.col(j + 1);
      target_[j] = target_[j + 1];
      sizes_[j] = sizes_[j + 1];
    }
    for (Eigen::Index j = i; j < last; ++j) gram_.row(j) = gram_.row(j + 1);
  }

  const ConeLoads& loads_;
  const Eigen::VectorXd& data_;
  std::vector<ConeRay> rays_;  ///< without sizes
  std::vector<double> lengths_;
  Eigen::MatrixXd columns_, gram_;
  Eigen::VectorXd target_, sizes_;
};

/// The ray of a cone along which a gradient is largest.
Eigen::Vector3d steepestRay(const Eigen::Vector3d& gradient, const Eigen::Vector3d& axis,
                            double friction) {
  const Eigen::Vector3d tangent = gradient - gradient.dot(axis) * axis;
  const double size = tangent.norm();
  if (!(size > 0) || friction == 0) return axis;
  return axis + friction / size * tangent;
}

}  // namespace

Eigen::Vector3d ConeFit::force(int load) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (const ConeRay& ray : rays)
    if (ray.load == load) force += ray.size * ray.direction;
  return force;
}

std::vector<int> ConeFit::loads() const {
  std::vector<int> loads;
  for (const ConeRay& ray : rays) loads.push_back(ray.load);
  std::sort(loads.begin(), loads.end());
  loads.erase(std::unique(loads.begin(), loads.end()), loads.end());
  return loads;
}

int ConeFit::freedom(double friction) const {
  int freedom = 0;
  for (int load : loads()) {
    int count = 0;
    for (const ConeRay& ray : rays) count += ray.load == load;
    freedom += friction == 0 ? 1 : std::min(count + 1, 3);
  }
  return freedom;
}

ConeFit fitInCones(const ConeLoads& loads, const Eigen::VectorXd& data, double tolerance) {
  if (loads.response.rows() != data.size() || loads.response.cols() != 3 * loads.axes.cols())
    refuse("a response of ", loads.response.rows(), " by ", loads.response.cols(),
           " numbers does not go with ", data.size(), " values and ", loads.axes.cols(), " loads");
  Eigen::VectorXd lengths(loads.count());  // of columns along the axes
  for (int k = 0; k < loads.count(); ++k)
    lengths[k] = (loads.response.middleCols<3>(3 * k) * loads.axes.col(k)).norm();
  ActiveRays active(loads, data);
  std::vector<bool> isBarred(loads.count(), false);  // joined to leave at once, by rounding
  ConeFit fit;
  fit.isSettled = false;
  for (int round = 0; round < kMostRounds && !fit.isSettled; ++round) {
    const Eigen::VectorXd gradients = loads.response.transpose() * active.residual();
    double most = tolerance;
    int best = -1;
    Eigen::Vector3d ray;
    for (int k = 0; k < loads.count(); ++k) {
      if (isBarred[k] || !(lengths[k] > 0)) continue;
      const Eigen::Vector3d gradient = gradients.segment<3>(3 * k);
      const Eigen::Vector3d here = steepestRay(gradient, loads.axes.col(k), loads.friction);
      const double gain = gradient.dot(here) / lengths[k];
      if (!(gain > most)) continue;
      most = gain;
      best = k;
      ray = here;
    }
    if (best < 0)
      fit.isSettled = true;
    else if (active.join(best, ray))
      std::fill(isBarred.begin(), isBarred.end(), false);
    else
      isBarred[best] = true;
  }
  fit.rays = active.rays();
  fit.squares = active.residual().squaredNorm();
  return fit;
}

}  // namespace palpate
