// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/contact_recovery.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "identification/contact_search.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kRadii[] = {0, 1.5, 2, 2.8, 4, 5.6, 8};  // in mean edges
constexpr int kMostWorse = 2;          // radii one after the other that explain less
constexpr double kRing = 1.2;          // likewise: sites beside a site
constexpr double kShareOfPeak = 1e-3;  // from which on a node bears
constexpr double kLargeMisfit = 1.5;
constexpr double kLargeDeviation = 0.2;  // of a force
constexpr double kWideFriction = 1;      // what tilted forces are tried with, at least
constexpr double kClearlyBetter = 6;     // of Schwarz's criterion (Kass and Raftery 1995)

std::string shownVector(const Eigen::Vector3d& v) {
  return sentence("(", shortly(v.x()), ", ", shortly(v.y()), ", ", shortly(v.z()), ")");
}

class Recovery {
 public:
  Recovery(const GreensFunctions& greens, const SurfaceMesh& mesh, const Eigen::VectorXi& patches,
           const ObservedDisplacements& observed, const RecoveryOptions& options,
           const Progress& progress)
      : greens_(greens),
        mesh_(mesh),
        observed_(observed),
        options_(options),
        progress_(progress),
        patches_(patches),
        sites_(sitesOf(greens, mesh, patches)),
        rings_(loadPatches(mesh, patches, sites_, kRing * mesh.meanEdgeLength())),
        response_(greens, mesh, sites_, observed, progress.part(0, 0.2)) {}

  ContactRecovery result();

 private:
  static std::vector<LoadSite> sitesOf(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                       const Eigen::VectorXi& patches);
  void findHypothesis();
  ContactSearch searchWith(double friction) const {
    return {sites_, rings_, response_, {friction, scale_, options_.yieldingSupport}};
  }
  Eigen::Matrix3Xd forcesOf(const LoadResponses& responses,
                            const ContactHypothesis& hypothesis) const;
  Eigen::VectorXd pressuresOf(const Eigen::Matrix3Xd& forces) const;
  std::vector<int> contactOfLoads() const;
  RecoveredContact contactOf(const std::vector<int>& loads) const;
  void addResiduals(ContactRecovery& result) const;
  std::vector<int> nearestContacts(const std::vector<RecoveredContact>& contacts) const;
  void addDeviations(ContactRecovery& result) const;
  void addSquares(const Eigen::Matrix3Xd& forces, double share, const std::vector<int>& nearest,
                  ContactRecovery& result) const;
  void addWarnings(ContactRecovery& result) const;

  const GreensFunctions& greens_;
  const SurfaceMesh& mesh_;
  const ObservedDisplacements& observed_;
  const RecoveryOptions& options_;
  const Progress& progress_;
  const Eigen::VectorXi& patches_;
  std::vector<LoadSite> sites_;
  std::vector<LoadPatch> rings_;
  ObservedResponse response_;
  double scale_ = 1;
  bool isScaleTold_ = false;
  LoadResponses responses_;
  ContactHypothesis best_;
  struct Alternative {
    double score;
    Eigen::Matrix3Xd forces;  // 3 by #nodes, N
  };
  std::vector<Alternative> alternatives_;  // the best for patches of each radius
};

std::vector<LoadSite> Recovery::sitesOf(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                        const Eigen::VectorXi& patches) {
  std::vector<int> nodes;
  for (int node : greens.info().columnNodes)
    if (!greens.isFixed(node)) nodes.push_back(node);
  if (nodes.empty())
    refuse("no free node has a column: compute the Green's functions where contacts may be");
  return loadSites(mesh, patches, nodes);
}

void Recovery::findHypothesis() {
  const bool isKnown = observed_.deviations.cols() > 0;
  double done = 0;
  int worse = 0;
  for (double edges : kRadii) {
    progress_.report(0.2 + 0.5 * done++ / std::size(kRadii), "contacts");
    const double radius = options_.radius >= 0 ? options_.radius : edges * mesh_.meanEdgeLength();
    LoadResponses responses =
        response_.responsesTo(loadPatches(mesh_, patches_, sites_, radius), radius);
    if (!isScaleTold_ && done == 1) {
      const double scale = noiseScale(responses, sites_, response_, options_.friction);
      isScaleTold_ = scale > 0;
      // Given deviations are believed where the residuals are smaller.
      if (isScaleTold_) scale_ = isKnown ? std::max(1.0, scale) : std::max(scale, 1e-6);
    }
    const ContactSearch search = searchWith(options_.friction);
    ContactHypothesis here = search.search(responses);
    alternatives_.push_back({here.score, forcesOf(responses, here)});
    if (here.score < best_.score) {
      best_ = std::move(here);
      responses_ = std::move(responses);
      worse = 0;
    } else if (++worse == kMostWorse) {
      break;
    }
    if (options_.radius >= 0) break;
  }
  if (best_.rays.empty())
    refuse("no contact explains the displacements better than their noise of ",
           shortly(scale_ * response_.unit()),
           " m does: observe larger ones, or nearer to contacts");
}

/// 3 by #nodes, N.
Eigen::Matrix3Xd Recovery::forcesOf(const LoadResponses& responses,
                                    const ContactHypothesis& hypothesis) const {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, mesh_.vertexCount());
  for (const ConeRay& ray : hypothesis.rays) {
    const LoadPatch& patch = responses.patches[ray.load];
    for (std::size_t j = 0; j < patch.sites.size(); ++j)
      forces.col(sites_[patch.sites[j]].vertex) += patch.shares[j] * ray.size * ray.direction;
  }
  return forces;
}

Eigen::VectorXd Recovery::pressuresOf(const Eigen::Matrix3Xd& forces) const {
  Eigen::VectorXd pressures = Eigen::VectorXd::Zero(mesh_.vertexCount());
  for (const LoadSite& site : sites_)
    pressures[site.vertex] =
        std::max(pressures[site.vertex],
                 forces.col(site.vertex).dot(site.axis) / greens_.vertexArea(site.vertex));
  return pressures;
}

/// Which contact each ray belongs to: loads are of one contact where their patches' middles are
/// within a radius of each other, and not on two sides of a wall.
std::vector<int> Recovery::contactOfLoads() const {
  const double most = std::max(responses_.radius, 2 * kRing * mesh_.meanEdgeLength());
  std::vector<int> contact(best_.rays.size(), -1);
  int count = 0;
  for (std::size_t seed = 0; seed < contact.size(); ++seed) {
    if (contact[seed] >= 0) continue;
    std::vector<std::size_t> reached{seed};
    contact[seed] = count;
    for (std::size_t next = 0; next < reached.size(); ++next)
      for (std::size_t other = 0; other < contact.size(); ++other) {
        const LoadSite &a = sites_[best_.rays[reached[next]].load],
                       &b = sites_[best_.rays[other].load];
        if (contact[other] >= 0 || a.axis.dot(b.axis) < -0.5 ||
            (mesh_.points().col(a.vertex) - mesh_.points().col(b.vertex)).norm() > most)
          continue;
        contact[other] = count;
        reached.push_back(other);
      }
    ++count;
  }
  return contact;
}

/// @param loads  indices into the rays.
RecoveredContact Recovery::contactOf(const std::vector<int>& loads) const {
  ContactHypothesis own;
  for (int ray : loads) own.rays.push_back(best_.rays[ray]);
  const Eigen::Matrix3Xd forces = forcesOf(responses_, own);
  const Eigen::VectorXd pressures = pressuresOf(forces);
  RecoveredContact contact;
  contact.pressure = pressures.maxCoeff(&contact.peak);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double total = 0;
  for (int node = 0; node < mesh_.vertexCount(); ++node) {
    if (!(pressures[node] > kShareOfPeak * contact.pressure)) continue;
    contact.nodes.push_back(node);
    contact.area += greens_.vertexArea(node);
    const double normal = pressures[node] * greens_.vertexArea(node);
    middle += normal * mesh_.points().col(node);
    total += normal;
  }
  const SurfacePoint on = nearestSurfacePoint(mesh_, middle / total);
  contact.centre = placeOf(mesh_, on);
  contact.force = forces.rowwise().sum();
  for (int node : contact.nodes) {
    const Eigen::Vector3d arm = mesh_.points().col(node) - contact.centre;
    contact.torque += arm.cross(Eigen::Vector3d(forces.col(node)));
  }
  return contact;
}

void Recovery::addResiduals(ContactRecovery& result) const {
  result.residuals.resize(3, observed_.displacements.cols());
  double squares = 0, over = 0;
  for (Eigen::Index i = 0; i < result.residuals.cols(); ++i) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      u += observed_.points[i].barycentric[k] *
           result.displacement.col(mesh_.triangles()(k, observed_.points[i].triangle));
    result.residuals.col(i) = observed_.displacements.col(i) - u;
    for (int c = 0; c < 3; ++c) {
      const double residual = result.residuals(c, i);
      if (std::isnan(residual)) continue;
      squares += residual * residual;
      if (observed_.deviations.cols() > 0)
        over += std::pow(residual / observed_.deviations(c, i), 2);
    }
  }
  const double left = std::max(1, response_.valueCount() - best_.freedom);
  result.noise = std::sqrt(squares / left);
  if (observed_.deviations.cols() > 0) result.misfit = std::sqrt(over / left);
}

/// Which contact is nearest to each node.
std::vector<int> Recovery::nearestContacts(const std::vector<RecoveredContact>& contacts) const {
  std::vector<int> nearest(mesh_.vertexCount(), -1);
  for (int node = 0; node < mesh_.vertexCount(); ++node) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (const double far = (mesh_.points().col(node) - contacts[c].centre).norm(); far < least) {
        least = far;
        nearest[node] = static_cast<int>(c);
      }
  }
  return nearest;
}

/// By recovering again from what was recovered, with other noise, and by what patches of other
/// radii tell, as far as Schwarz's criterion makes them probable beside the best.
void Recovery::addDeviations(ContactRecovery& result) const {
  result.pressureDeviation.setZero(mesh_.vertexCount());
  if (options_.samples < 2) return;
  const std::vector<int> nearest = nearestContacts(result.contacts);
  const auto add = [&](const Eigen::Matrix3Xd& forces, double share) {
    addSquares(forces, share, nearest, result);
  };
  const ContactSearch search = searchWith(options_.friction);
  const Eigen::VectorXd exact = search.explained(responses_, best_);
  std::mt19937 random(options_.seed);
  std::normal_distribution<double> normal(0, scale_);
  for (int sample = 0; sample < options_.samples; ++sample) {
    progress_.report(0.7 + 0.3 * sample / options_.samples, "deviations");
    Eigen::VectorXd data = exact;
    for (double& value : data) value += normal(random);
    add(forcesOf(responses_, search.fitted(responses_, best_, data)), 1.0 / options_.samples);
  }
  double all = 0;
  for (const Alternative& other : alternatives_) all += std::exp((best_.score - other.score) / 2);
  for (const Alternative& other : alternatives_)
    add(other.forces, std::exp((best_.score - other.score) / 2) / all);

  result.pressureDeviation = result.pressureDeviation.cwiseSqrt();
  result.forceDeviation = result.forceDeviation.cwiseSqrt();
  for (RecoveredContact& contact : result.contacts) {
    contact.forceDeviation = contact.forceDeviation.cwiseSqrt();
    contact.centreDeviation = std::sqrt(contact.centreDeviation);
  }
}

/// Adds squared differences of other forces from those recovered to the deviations.
/// @param forces  3 by #nodes, N.
void Recovery::addSquares(const Eigen::Matrix3Xd& forces, double share,
                          const std::vector<int>& nearest, ContactRecovery& result) const {
  const std::size_t count = result.contacts.size();
  const Eigen::VectorXd pressures = pressuresOf(forces);
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, count), middles = sums;
  Eigen::VectorXd normals = Eigen::VectorXd::Zero(count);
  for (int node = 0; node < mesh_.vertexCount(); ++node) {
    const int c = nearest[node];
    const double pushed = pressures[node] * greens_.vertexArea(node);
    sums.col(c) += forces.col(node);
    middles.col(c) += pushed * (mesh_.points().col(node) - result.contacts[c].centre);
    normals[c] += pushed;
  }
  result.forceDeviation += share * (forces.rowwise().sum() - result.force).cwiseAbs2();
  result.pressureDeviation += share * (pressures - result.pressure).cwiseAbs2();
  for (std::size_t c = 0; c < count; ++c) {
    RecoveredContact& contact = result.contacts[c];
    contact.forceDeviation += share * (sums.col(c) - contact.force).cwiseAbs2();
    if (!(normals[c] > 0)) continue;
    const Eigen::Vector3d axis = mesh_.vertexNormals().col(contact.peak),
                          shift = middles.col(c) / normals[c];
    contact.centreDeviation += share * (shift - axis.dot(shift) * axis).squaredNorm();
  }
}

void Recovery::addWarnings(ContactRecovery& result) const {
  const auto warn = [&](auto&&... parts) { result.warnings.push_back(sentence(parts...)); };
  if (!isScaleTold_ && observed_.deviations.cols() == 0)
    warn("the displacements are too few to tell their noise: 1 % of the largest is assumed");
  if (result.misfit > kLargeMisfit)
    warn("the residuals are ", shortly(result.misfit),
         " times the standard deviations given: the body is not quite the model");
  if (best_.yields)
    warn("the support gives way by other than the model's, which makes ",
         shortly(100 * result.yieldShare),
         " % of the displacements: forces go by how the body deforms, and are less certain");
  if (const int missing = greens_.missingCount(); missing > 0)
    warn(missing, " free nodes have no column: contacts there are not looked for");
  for (std::size_t c = 0; c < result.contacts.size(); ++c) {
    const RecoveredContact& contact = result.contacts[c];
    if (contact.forceDeviation.norm() > kLargeDeviation * contact.force.norm())
      warn("the displacements hardly tell the force of contact ", c + 1, ", ",
           shortly(contact.force.norm()), " N with a standard deviation of ",
           shortly(contact.forceDeviation.norm()), " N: observe more of them near ",
           shownVector(contact.centre));
  }
  const ContactHypothesis tilted = searchWith(std::max(kWideFriction, 2 * options_.friction))
                                       .fitted(responses_, best_, response_.data());
  if (tilted.score < best_.score - kClearlyBetter)
    warn("the forces are at the limit of friction, ", options_.friction,
         ", and more tilted ones explain the displacements better: allow a larger coefficient");
}

ContactRecovery Recovery::result() {
  findHypothesis();
  ContactRecovery result;
  const Eigen::Matrix3Xd forces = forcesOf(responses_, best_);
  result.traction.setZero(3, mesh_.vertexCount());
  for (const LoadSite& site : sites_)
    result.traction.col(site.vertex) = forces.col(site.vertex) / greens_.vertexArea(site.vertex);
  result.pressure = pressuresOf(forces);
  result.force = forces.rowwise().sum();
  result.radius = responses_.radius;
  result.displacement = solveReferenceProblem(greens_, result.traction);
  for (int node : greens_.info().conditions.fixedNodes()) result.displacement.col(node).setZero();
  if (best_.yields) {
    result.yield = best_.yield;
    const Eigen::Matrix<double, 6, 1> wrench = best_.wrench(responses_);
    for (int node = 0; node < mesh_.vertexCount(); ++node)
      result.displacement.col(node) +=
          response_.rigidMotion(best_.yield, wrench, mesh_.points().col(node));
    result.yieldShare = (response_.yieldColumns(wrench) *
                         Eigen::Vector2d(best_.yield.translation, best_.yield.rotation))
                            .norm() /
                        response_.data().norm();
  }
  const std::vector<int> contactOf = contactOfLoads();
  const int count = 1 + *std::max_element(contactOf.begin(), contactOf.end());
  for (int c = 0; c < count; ++c) {
    std::vector<int> loads;
    for (std::size_t r = 0; r < contactOf.size(); ++r)
      if (contactOf[r] == c) loads.push_back(static_cast<int>(r));
    result.contacts.push_back(this->contactOf(loads));
  }
  std::stable_sort(result.contacts.begin(), result.contacts.end(),
                   [](const RecoveredContact& a, const RecoveredContact& b) {
                     return a.force.norm() > b.force.norm();
                   });
  addResiduals(result);
  addDeviations(result);
  addWarnings(result);
  progress_.report(1, "done");
  return result;
}

void requireOptions(const RecoveryOptions& options, const SurfaceMesh& mesh) {
  if (!(options.friction >= 0 && options.friction <= 100))
    refuse("friction must be from 0 to 100, not ", options.friction);
  if (std::isnan(options.radius) || options.radius == INFINITY)
    refuse("the radius of the patches must be a number, not ", options.radius);
  if (options.radius > mesh.diagonal())
    refuse("patches of radius ", shortly(options.radius), " m are larger than the body, ",
           shortly(mesh.diagonal()), " m: are both in metres?");
  if (options.samples < 0 || options.samples > 100000)
    refuse("deviations are found from 0 to 100000 samples, not ", options.samples);
}

}  // namespace

ContactRecovery recoverContacts(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                const Eigen::VectorXi& patches,
                                const ObservedDisplacements& observed,
                                const RecoveryOptions& options, const Progress& progress) {
  requireOptions(options, mesh);
  requireUsable(mesh, observed);
  return Recovery(greens, mesh, patches, observed, options, progress).result();
}

}  // namespace palpate
