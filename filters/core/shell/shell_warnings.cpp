// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_warnings.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "sentence.h"
#include "shell/shell_curvature.h"

namespace palpate::shell {
namespace {

constexpr double kThickFrom = 0.2;      // of the piece's width, or the radius of curvature
constexpr double kRoundingFrom = 1e-4;  // of a rigid motion
constexpr double kNarrowBelow = 1.5;    // edges

/// One piece of the surface.
struct Piece {
  double area = 0, thickest = 0, edges = 0;
  int edgeCount = 0, firstVertex = -1;
  Eigen::AlignedBox3d support;
  /// A side of a square of the same area.
  double width() const { return std::sqrt(area); }
  double meanEdge() const { return edges / edgeCount; }
};

std::vector<Piece> piecesOf(const ElasticModel& model, const ThinShell& shell) {
  const SurfaceMesh& mesh = model.mesh();
  std::vector<Piece> pieces(mesh.bodyCount());
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    Piece& piece = pieces[mesh.bodyOfVertex(v)];
    if (piece.firstVertex < 0) piece.firstVertex = v;
    if (shell.held().col(v).any()) piece.support.extend(mesh.points().col(v));
  }
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    Piece& piece = pieces[mesh.bodyOfVertex(mesh.triangles()(0, f))];
    piece.area += mesh.triangleAreas()[f];
    piece.thickest = std::max(piece.thickest, shell.thickness().col(f).maxCoeff());
    for (int k = 0; k < 3; ++k) {
      piece.edges += (mesh.points().col(mesh.triangles()(k, f)) -
                      mesh.points().col(mesh.triangles()((k + 1) % 3, f)))
                         .norm();
      ++piece.edgeCount;
    }
  }
  return pieces;
}

void warnOfPieces(const ElasticModel& model, const ThinShell& shell,
                  std::vector<std::string>& warnings) {
  for (const Piece& piece : piecesOf(model, shell)) {
    const std::string name = sentence("the piece of the shell with vertex ", piece.firstVertex);
    const double ratio = piece.thickest / piece.width(), edge = piece.meanEdge();
    if (ratio > kThickFrom)
      warnings.push_back(sentence(name, " is thick (thickness over width ", shortly(ratio),
                                  "): a shell's model has neither shear nor squeezing across it; "
                                  "precompute it as a solid body"));
    else if (piece.thickest > edge)
      warnings.push_back(sentence(name,
                                  " has edges shorter than its thickness (mean edge over "
                                  "thickness ",
                                  shortly(edge / piece.thickest),
                                  "): contacts as small as these feel it bend, not sink in"));
    const double support = piece.support.diagonal().norm() / edge;
    if (shell.isClamped() && support < kNarrowBelow)
      warnings.push_back(sentence(name, " is clamped over ", shortly(support),
                                  " edges only: how far it turns there depends on the mesh; fix "
                                  "more of it"));
  }
}

void warnOfCurvature(const ElasticModel& model, const ThinShell& shell,
                     std::vector<std::string>& warnings) {
  const SurfaceMesh& mesh = model.mesh();
  const Eigen::VectorXd curvatures = meanCurvatures(mesh);
  double worst = 0;
  int triangle = -1;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const double ratio = shell.thickness().col(f).mean() * curvatures[f];
    if (ratio <= worst) continue;
    worst = ratio;
    triangle = f;
  }
  if (worst > kThickFrom)
    warnings.push_back(sentence("the shell is thick beside its radius of curvature at triangle ",
                                triangle, " (thickness times mean curvature ", shortly(worst),
                                "): lines across it are no longer straight; precompute it as a "
                                "solid body"));
}

}  // namespace

std::string roundingSentence(const ElasticModel& model, const ThinShell& shell,
                             double rigidMotionDefect) {
  return sentence("rounding shows: ",
                  rigidMotionDefect < 0
                      ? "the stiffness matrix is singular"
                      : "rigid motions err by " + shortly(rigidMotionDefect) + " of themselves",
                  "; the shell is very thin (", shortly(shell.thinnest() / model.mesh().diagonal()),
                  " of its size) or has needles of triangles");
}

std::vector<std::string> shellWarnings(const ElasticModel& model, const ThinShell& shell,
                                       double rigidMotionDefect) {
  std::vector<std::string> warnings;
  warnOfPieces(model, shell, warnings);
  warnOfCurvature(model, shell, warnings);
  if (rigidMotionDefect > kRoundingFrom)
    warnings.push_back(roundingSentence(model, shell, rigidMotionDefect));
  return warnings;
}

}  // namespace palpate::shell
