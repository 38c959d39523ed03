// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/load_patches.h"

#include <algorithm>

namespace palpate {
namespace {

constexpr double kLeastCosine = 0.5;

/// Which sites a vertex has.
class SitesOfVertices {
 public:
  SitesOfVertices(const std::vector<LoadSite>& sites, int vertexCount)
      : sites_(sites), first_(vertexCount + 1, 0) {
    for (const LoadSite& site : sites) ++first_[site.vertex + 1];
    for (int v = 0; v < vertexCount; ++v) first_[v + 1] += first_[v];
  }
  /// -1 where it has none of this patch.
  int at(int vertex, int patch) const {
    for (int i = first_[vertex]; i < first_[vertex + 1]; ++i)
      if (sites_[i].patch == patch) return i;
    return -1;
  }

 private:
  const std::vector<LoadSite>& sites_;
  std::vector<int> first_;
};

}  // namespace

std::vector<LoadSite> loadSites(const SurfaceMesh& mesh, const Eigen::VectorXi& patches,
                                const std::vector<int>& vertices) {
  std::vector<int> sorted = vertices;
  std::sort(sorted.begin(), sorted.end());
  std::vector<LoadSite> sites;
  for (int vertex : sorted) {
    const std::size_t first = sites.size();
    for (int triangle : mesh.trianglesOfVertex(vertex)) {
      const auto isHere = [&](const LoadSite& site) { return site.patch == patches[triangle]; };
      auto site = std::find_if(sites.begin() + first, sites.end(), isHere);
      if (site == sites.end())
        site = sites.insert(site, {vertex, patches[triangle], Eigen::Vector3d::Zero(), 0});
      site->axis -= mesh.triangleAreas()[triangle] * mesh.triangleNormals().col(triangle);
      site->area += mesh.triangleAreas()[triangle] / 3;
    }
  }
  for (LoadSite& site : sites) site.axis.normalize();
  return sites;
}

std::vector<LoadPatch> loadPatches(const SurfaceMesh& mesh, const Eigen::VectorXi& patches,
                                   const std::vector<LoadSite>& sites, double radius) {
  const SitesOfVertices sitesOf(sites, mesh.vertexCount());
  std::vector<int> seenFrom(sites.size(), -1);
  const auto distance = [&](int a, int b) {
    return (mesh.points().col(sites[a].vertex) - mesh.points().col(sites[b].vertex)).norm();
  };
  std::vector<LoadPatch> result(sites.size());
  for (int i = 0; i < int(sites.size()); ++i) {
    LoadPatch& patch = result[i];
    patch.sites.push_back(i);
    seenFrom[i] = i;
    double total = 0;
    for (std::size_t next = 0; next < patch.sites.size(); ++next) {
      const int site = patch.sites[next];
      const double far = next == 0 ? 0 : distance(site, i) / radius;
      patch.shares.push_back(sites[site].area * (1 - far * far));
      total += patch.shares.back();
      for (int triangle : mesh.trianglesOfVertex(sites[site].vertex)) {
        if (patches[triangle] != sites[i].patch) continue;
        for (int vertex : mesh.triangles().col(triangle)) {
          const int other = sitesOf.at(vertex, sites[i].patch);
          if (other < 0 || seenFrom[other] == i || !(distance(other, i) < radius) ||
              sites[other].axis.dot(sites[i].axis) < kLeastCosine)
            continue;
          seenFrom[other] = i;
          patch.sites.push_back(other);
        }
      }
    }
    for (double& share : patch.shares) share /= total;
  }
  return result;
}

}  // namespace palpate
