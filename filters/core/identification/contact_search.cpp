// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/contact_search.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/QR>

namespace palpate {
namespace {

constexpr double kTolerance = 0.03;    // of a fit, over the noise
constexpr double kWorthwhile = 0.6;    // likewise, of a ray, where the noise is not known
constexpr double kNoiseSettled = 0.9;  // from one estimate of the noise to the next
constexpr int kMostNoiseRounds = 30;
constexpr double kYieldSettled = 0.3;  // of the yield's share of the values, likewise
constexpr double kMostYield = 0.6;     // of all values' norm: beyond, nothing is held
constexpr int kYieldFreedom = 4;       // counted twice: it must pay well before forces go by it
constexpr int kPlaceFreedom = 2;       // of a seed
constexpr int kMostYieldRounds = 8, kMostMoves = 8, kMostSteps = 24;
constexpr double kLeastLeft = 0.3;       // of the values, for the noise to be told
constexpr double kLeastFreeValues = 12;  // likewise

ConeLoads loadsAt(const std::vector<LoadSite>& sites, const std::vector<int>& which,
                  double friction) {
  ConeLoads loads;
  loads.friction = friction;
  loads.axes.resize(3, which.size());
  for (std::size_t k = 0; k < which.size(); ++k) loads.axes.col(k) = sites[which[k]].axis;
  return loads;
}

void sortUnique(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

Eigen::Matrix<double, 6, 1> ContactHypothesis::wrench(const LoadResponses& responses) const {
  Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
  for (const ConeRay& ray : rays)
    wrench += responses.wrenches.middleCols<3>(3 * ray.load) * (ray.size * ray.direction);
  return wrench;
}

ContactSearch::ContactSearch(const std::vector<LoadSite>& sites,
                             const std::vector<LoadPatch>& rings, const ObservedResponse& response,
                             const Settings& settings)
    : sites_(sites),
      rings_(rings),
      response_(response),
      friction_(settings.friction),
      scale_(settings.scale),
      mayYield_(settings.mayYield && response.canYield()) {}

Eigen::VectorXd ContactSearch::explained(const LoadResponses& responses,
                                         const ContactHypothesis& hypothesis) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(response_.data().size());
  for (const ConeRay& ray : hypothesis.rays)
    values.noalias() +=
        response_.columns(responses, {ray.load}, hypothesis.yield) * (ray.size * ray.direction);
  return values;
}

/// Forces on the sites about the seeds, and how the support yields.
void ContactSearch::fit(const LoadResponses& responses, ContactHypothesis& hypothesis,
                        const Eigen::VectorXd& data) const {
  std::vector<int> candidates;
  for (int seed : hypothesis.seeds)
    candidates.insert(candidates.end(), rings_[seed].sites.begin(), rings_[seed].sites.end());
  sortUnique(candidates);
  ConeLoads loads = loadsAt(sites_, candidates, friction_);
  for (int round = 0;; ++round) {
    loads.response = response_.columns(responses, candidates, hypothesis.yield);
    const ConeFit fit = fitInCones(loads, data, kTolerance * scale_);
    hypothesis.squares = fit.squares;
    hypothesis.freedom =
        fit.freedom(friction_) + kPlaceFreedom * static_cast<int>(hypothesis.seeds.size());
    hypothesis.rays = fit.rays;
    for (ConeRay& ray : hypothesis.rays) ray.load = candidates[ray.load];
    if (!hypothesis.yields || round == kMostYieldRounds ||
        !improveYield(responses, hypothesis, data))
      break;
  }
  if (hypothesis.yields) hypothesis.freedom += kYieldFreedom;
  hypothesis.score = hypothesis.squares / (scale_ * scale_) +
                     hypothesis.freedom * std::log(double(response_.valueCount()));
  if (hypothesis.yields &&
      !((response_.yieldColumns(hypothesis.wrench(responses)) *
         Eigen::Vector2d(hypothesis.yield.translation, hypothesis.yield.rotation))
            .norm() <= kMostYield * data.norm()))
    hypothesis.score = std::numeric_limits<double>::infinity();
}

/// A step of Gauss and Newton's for the yield together with the forces that bear.
/// @return whether it moves anything by more than the noise.
bool ContactSearch::improveYield(const LoadResponses& responses, ContactHypothesis& hypothesis,
                                 const Eigen::VectorXd& data) const {
  const Eigen::Index count = static_cast<Eigen::Index>(hypothesis.rays.size());
  if (count == 0) return false;
  Eigen::MatrixXd jacobian(data.size(), count + 2);
  Eigen::VectorXd residual = data;
  for (Eigen::Index r = 0; r < count; ++r) {
    const ConeRay& ray = hypothesis.rays[r];
    jacobian.col(r) = response_.columns(responses, {ray.load}, hypothesis.yield) * ray.direction;
    residual -= ray.size * jacobian.col(r);
  }
  jacobian.rightCols<2>() = response_.yieldColumns(hypothesis.wrench(responses));
  const Eigen::VectorXd lengths = jacobian.colwise().norm().cwiseMax(1e-300);
  const Eigen::VectorXd step = (jacobian * lengths.cwiseInverse().asDiagonal())
                                   .colPivHouseholderQr()
                                   .solve(residual)
                                   .cwiseQuotient(lengths);
  if (!(step.tail<2>().cwiseProduct(lengths.tail<2>()).norm() > kYieldSettled * scale_))
    return false;
  hypothesis.yield.translation += step[count];
  hypothesis.yield.rotation += step[count + 1];
  return true;
}

/// Each to where most bears of what is beside it; those beside which nothing does are left out.
std::vector<int> ContactSearch::movedSeeds(const ContactHypothesis& hypothesis) const {
  std::vector<double> normal(sites_.size(), 0);
  for (const ConeRay& ray : hypothesis.rays) normal[ray.load] += ray.size;
  std::vector<int> moved;
  for (int seed : hypothesis.seeds) {
    int to = seed;
    for (int other : rings_[seed].sites)
      if (normal[other] > normal[to]) to = other;
    if (normal[to] > 0) moved.push_back(to);
  }
  sortUnique(moved);
  return moved;
}

ContactHypothesis ContactSearch::fitted(const LoadResponses& responses,
                                        ContactHypothesis hypothesis,
                                        const Eigen::VectorXd& data) const {
  hypothesis.score = std::numeric_limits<double>::infinity();
  ContactHypothesis best = hypothesis;
  for (int move = 0; move < kMostMoves && !hypothesis.seeds.empty(); ++move) {
    fit(responses, hypothesis, data);
    if (hypothesis.score < best.score) best = hypothesis;
    std::vector<int> moved = movedSeeds(hypothesis);
    if (moved == hypothesis.seeds) break;
    hypothesis.seeds = std::move(moved);
  }
  return best;
}

/// By how much a force at one site would lower the squares, with all others fitted anew.
/// @param columns  of the site, at right angles to those of the forces that bear.
double ContactSearch::gainOf(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residual,
                             int site) const {
  constexpr int rays = 12;
  const Eigen::Vector3d gradient = columns.transpose() * residual, axis = sites_[site].axis;
  const Eigen::Matrix3d gram = columns.transpose() * columns;
  double gain = 0;
  const auto consider = [&](const Eigen::Vector3d& ray) {
    const double along = gradient.dot(ray);
    if (along > 0) gain = std::max(gain, along * along / ray.dot(gram * ray));
  };
  consider(axis);
  if (friction_ == 0) return gain;
  const Eigen::Vector3d force = gram.ldlt().solve(gradient);
  const double normal = force.dot(axis);
  if ((force - normal * axis).norm() <= friction_ * normal)
    gain = std::max(gain, gradient.dot(force));
  const Eigen::Vector3d across = axis.unitOrthogonal();
  for (int i = 0; i < rays; ++i) {
    const double angle = 2 * M_PI * i / rays;
    consider(axis + friction_ * (std::cos(angle) * across + std::sin(angle) * axis.cross(across)));
  }
  return gain;
}

int ContactSearch::nextSeed(const LoadResponses& responses,
                            const ContactHypothesis& hypothesis) const {
  const Eigen::VectorXd residual = response_.data() - explained(responses, hypothesis);
  const Eigen::Index count = static_cast<Eigen::Index>(hypothesis.rays.size());
  Eigen::MatrixXd basis(residual.size(), count);
  for (Eigen::Index r = 0; r < count; ++r)
    basis.col(r) = response_.columns(responses, {hypothesis.rays[r].load}, hypothesis.yield) *
                   hypothesis.rays[r].direction;
  if (count > 0)
    basis = Eigen::HouseholderQR<Eigen::MatrixXd>(basis).householderQ() *
            Eigen::MatrixXd::Identity(residual.size(), count).eval();
  double most = 0;
  int best = -1;
  for (int site = 0; site < int(sites_.size()); ++site) {
    Eigen::MatrixXd columns = response_.columns(responses, {site}, hypothesis.yield);
    columns -= basis * (basis.transpose() * columns).eval();
    const double gain = gainOf(columns, residual, site);
    if (!(gain > most)) continue;
    most = gain;
    best = site;
  }
  return best;
}

/// Without seeds that no longer pay beside those that came after them.
ContactHypothesis ContactSearch::thinned(const LoadResponses& responses,
                                         ContactHypothesis hypothesis) const {
  for (std::size_t i = 0; i < hypothesis.seeds.size() && hypothesis.seeds.size() > 1;) {
    ContactHypothesis fewer = hypothesis;
    fewer.seeds.erase(fewer.seeds.begin() + static_cast<std::ptrdiff_t>(i));
    fewer = fitted(responses, fewer, response_.data());
    if (fewer.score < hypothesis.score) {
      hypothesis = fewer;
      i = 0;
    } else {
      ++i;
    }
  }
  return hypothesis;
}

ContactHypothesis ContactSearch::search(const LoadResponses& responses) const {
  ContactHypothesis best;
  best.squares = response_.data().squaredNorm();
  best.score = best.squares / (scale_ * scale_);
  for (int step = 0; step < kMostSteps; ++step) {
    ContactHypothesis next = best;
    const int seed = nextSeed(responses, best);
    if (seed >= 0) {
      next.seeds.push_back(seed);
      sortUnique(next.seeds);
      next = fitted(responses, next, response_.data());
    }
    if (!best.yields && !best.seeds.empty() && mayYield_) {
      ContactHypothesis yielding = best;
      yielding.yields = true;
      yielding = fitted(responses, yielding, response_.data());
      if (yielding.score < next.score) next = yielding;
    }
    if (!(next.score < best.score)) break;
    best = next;
  }
  return thinned(responses, best);
}

double noiseScale(const LoadResponses& single, const std::vector<LoadSite>& sites,
                  const ObservedResponse& response, double friction) {
  std::vector<int> all(sites.size());
  for (std::size_t k = 0; k < sites.size(); ++k) all[k] = static_cast<int>(k);
  ConeLoads loads = loadsAt(sites, all, friction);
  loads.response = single.firm;
  const double count = response.valueCount();
  double scale = response.data().norm() / std::sqrt(count);
  for (int round = 0; round < kMostNoiseRounds; ++round) {
    const ConeFit fit = fitInCones(loads, response.data(), kWorthwhile * scale);
    const double left = count - fit.freedom(friction);
    if (!(left >= std::max(kLeastLeft * count, kLeastFreeValues))) return -1;
    const double next = std::sqrt(fit.squares / left);
    if (!(next < kNoiseSettled * scale)) return std::min(next, scale);
    scale = next;
  }
  return scale;
}

}  // namespace palpate
