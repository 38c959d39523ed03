// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/elastic_model.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "mesh/wall_thickness.h"
#include "model/plane.h"
#include "model/support.h"
#include "sentence.h"

namespace palpate {

ElasticModel::ElasticModel(std::shared_ptr<const SurfaceMesh> mesh, Material material,
                           BoundaryConditions conditions, Eigen::VectorXi smoothPatches,
                           Domain domain)
    : mesh_(std::move(mesh)),
      material_(material),
      conditions_(std::move(conditions)),
      smoothPatches_(std::move(smoothPatches)),
      domain_(domain) {
  std::ostringstream text;
  if (conditions_.nodeCount() != mesh_->vertexCount())
    text << "there are " << conditions_.nodeCount() << " boundary types for "
         << mesh_->vertexCount() << " vertices";
  else if (smoothPatches_.size() != mesh_->triangleCount())
    text << "there are " << smoothPatches_.size() << " smooth patch numbers for "
         << mesh_->triangleCount() << " triangles";
  else if (conditions_.freeNodes().empty())
    text << "the model has no free node: there is nothing that could be touched";
  if (!text.str().empty()) throw std::invalid_argument(text.str());

  if (domain_ == Domain::HalfSpace) {
    planeOf(*mesh_);
    requireNoneFixed("a half-space needs no support and has nothing to hold it by");
  } else if (mesh_->rims() == Rims::Allowed && rimsOf(domain_) == Rims::Refused) {
    throw std::invalid_argument(
        "a sheet with rims bounds a half-space, is a shell's middle or belongs to a given matrix, "
        "it "
        "bounds no other domain");
  }
  if (domain_ == Domain::Unsupported) requireNoneFixed("nothing holds an unsupported body");
  if (domain_ == Domain::Interior) requireSupport(*mesh_, conditions_);
  for (int shell = 0; domain_ == Domain::Exterior && shell < mesh_->shellCount(); ++shell)
    if (mesh_->isCavity(shell))
      throw std::invalid_argument(
          "in an exterior domain no surface may lie inside another: the material is outside all");
}

void ElasticModel::requireNoneFixed(const char* reason) const {
  const std::vector<int> fixed = conditions_.fixedNodes();
  if (fixed.empty()) return;
  throw std::invalid_argument("vertex " + std::to_string(fixed.front()) + " is fixed: " + reason +
                              ", leave all vertices free");
}

std::uint64_t ElasticModel::fingerprint() const {
  return modelFingerprint(*mesh_, conditions_, smoothPatches_, material_.poissonRatio(), domain_);
}

ElasticModel withSupportPatch(const ElasticModel& model) {
  return ElasticModel(model.sharedMesh(), model.material(), model.conditions(),
                      splitAtSupport(model.mesh(), model.conditions(), model.smoothPatches()),
                      model.domain());
}

std::uint64_t modelFingerprint(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                               const Eigen::VectorXi& smoothPatches, double poissonRatio,
                               Domain domain) {
  const auto side = static_cast<unsigned char>(domain);
  return Fingerprint()
      .add(mesh)
      .add(conditions.types().data(), conditions.types().size())
      .add(smoothPatches.data(), sizeof(int) * smoothPatches.size())
      .add(&poissonRatio, sizeof poissonRatio)
      .add(&side, sizeof side)
      .value();
}

std::vector<std::string> modelWarnings(const ElasticModel& model, double& wallRatio,
                                       double& supportWidth) {
  constexpr double thinFrom = 0.5, veryThinFrom = 1.5;
  std::vector<std::string> warnings;
  const WallRatio wall = model.domain() == Domain::Interior || model.domain() == Domain::Unsupported
                             ? largestWallRatio(model.mesh())
                             : WallRatio{};
  wallRatio = wall.ratio;
  if (wallRatio > veryThinFrom)
    warnings.push_back(sentence(
        "the wall at triangle ", wall.triangle,
        " is thinner than the edges there (edge over thickness ", shortly(wallRatio),
        "): it is too stiff in bending; refine until edges are shorter than the wall is thick"));
  else if (wallRatio > thinFrom)
    warnings.push_back(sentence("the wall at triangle ", wall.triangle,
                                " is thin for the mesh (edge over thickness ", shortly(wallRatio),
                                "): if it bends, compare with a finer mesh"));
  for (std::string& warning : supportWarnings(model, supportWidth))
    warnings.push_back(std::move(warning));
  return warnings;
}

std::vector<std::string> supportWarnings(const ElasticModel& model, double& supportWidth) {
  constexpr double narrowBelow = 3;
  const double width = supportWidthInEdges(model.mesh(), model.conditions());
  supportWidth = std::isfinite(width) ? width : -1;
  if (!(width < narrowBelow)) return {};
  return {sentence("a support is only ", shortly(width),
                   " edges wide: its compliance depends on the mesh; fix an area at least ",
                   narrowBelow, " edges wide")};
}

}  // namespace palpate
