// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy/body_levels.h"
#include "accuracy/settings.h"
#include "greens/greens_functions.h"

namespace palpate::app {

/// Numbers that answer a query, the same ones on every level.
struct Answer {
  Eigen::VectorXd values;
  Eigen::VectorXd weights;  ///< of their squares
  int group = 1;            ///< numbers in a row that are one thing, as a compliance
  Eigen::VectorXd exact;    ///< of the same size, where the answer is known; else empty
};

/// The largest |values - reference| / |reference| of a group, in the weighted norm.
/// @param answer  whose weights and groups are those of the values.
double relativeError(const Answer& answer, const Eigen::VectorXd& values,
                     const Eigen::VectorXd& reference);

/// A query that is ready to be made of some Green's functions.
class PreparedQuery {
 public:
  virtual ~PreparedQuery() = default;
  /// What is timed.
  virtual void evaluate() = 0;
  /// Of the last evaluation.
  virtual Answer answer() const = 0;
};

/// What is asked, of any level of a body.
class Query {
 public:
  virtual ~Query() = default;
  /// Nodes whose columns it takes; all nodes' or all free nodes' are listed as well.
  virtual std::vector<int> columns(const Setting& setting) const = 0;
  /// Whether it takes the columns of single patches.
  virtual bool usesPatchColumns() const { return false; }
  virtual std::unique_ptr<PreparedQuery> prepare(std::shared_ptr<const GreensFunctions> greens,
                                                 const Setting& setting) const = 0;
  /// What an error is of, for people.
  virtual std::string description() const = 0;
};

/// A point on all levels, the first level's first.
using LevelledPoint = std::vector<SurfacePoint>;

/// The displacement of points under unit forces along x, y, z, spread by a linear mask of the
/// setting's radius around each; between vertices it is the average of theirs.
std::unique_ptr<const Query> complianceQuery(const BodyLevels& body,
                                             const std::vector<LevelledPoint>& points);

/// The displacement of the vertices of level 1, on whatever level, under the same forces.
std::unique_ptr<const Query> surfaceQuery(const BodyLevels& body,
                                          const std::vector<LevelledPoint>& points);

/// The displacement of all free vertices in the field of a point force outside the body, whose
/// tractions and displacements are given on its boundary. Its answers are known.
/// @param source  m.
std::unique_ptr<const Query> pointSourceQuery(const BodyLevels& body,
                                              const Eigen::Vector3d& source);

/// The force on a ball that is pressed in along the normal at points, one after the other.
/// @param depth  of the ball's foremost point below the undeformed surface, m.
std::unique_ptr<const Query> forceQuery(const BodyLevels& body,
                                        const std::vector<LevelledPoint>& points, double ballRadius,
                                        double depth);

}  // namespace palpate::app
