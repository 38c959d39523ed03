// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <map>

#include "accuracy/query.h"

namespace palpate::app {

/// What errors are measured against.
class Reference {
 public:
  /// Answers that know the truth themselves.
  static Reference exact(std::string name);
  /// Numbers from elsewhere, for all radii.
  static Reference given(std::string name, Eigen::VectorXd values);
  /// Boussinesq's and Cerruti's solutions integrated over linear masks in the middle of a
  /// half-space's surface: the compliance at their centres.
  /// @param normal  out of the half-space.
  /// @param points  how many.
  static Reference boussinesq(const Material& material, const Eigen::Vector3d& normal,
                              const std::vector<double>& radii, int points);
  /// Richardson's extrapolation of the finest three levels (of two, if there are no more), with the
  /// support as patches of its own.
  /// @param radii  that there will be settings of.
  /// @throws std::invalid_argument for a single level; Aborted.
  static Reference finest(const BodyLevels& body, const Query& query, const Setting& base,
                          const std::vector<double>& radii, int threads, const Progress& progress);

  /// With its parameters, for people.
  const std::string& name() const { return name_; }
  double errorOf(const Answer& answer, const Setting& setting) const;
  /// How far it may be from the truth itself, relative; 0 where nothing is known of that.
  double uncertainty(const Setting& setting) const;

 private:
  struct Values {
    Eigen::VectorXd values;
    double uncertainty = 0;
  };
  const Values* find(const Setting& setting) const;

  std::string name_;
  bool isForAllRadii_ = false;
  std::map<double, Values> ofRadius_;
};

/// A table of compliances at points.
struct ComplianceTable {
  std::vector<double> points;  ///< x y z of each, m
  Eigen::VectorXd values;      ///< 9 a point, column by column, m/N
};

/// Reads lines of twelve numbers, x,y,z,cxx,cxy,cxz,cyx,cyy,cyz,czx,czy,czz: the displacement along
/// the first letter by a unit force along the second. A first line of words is skipped, as are
/// empty ones and those that begin with #.
/// @throws std::runtime_error naming the file and its bad line.
ComplianceTable readCompliances(const std::string& path);

}  // namespace palpate::app
