// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/given_checks.h"

#include <cmath>
#include <random>

#include "model/plausible_modulus.h"
#include "sentence.h"

namespace palpate::imported {
namespace {

// Shares of the work that each point's own stiffness would do.
constexpr double kFree = 1e-10;     // a motion that nothing resists, in double precision
constexpr double kLoose = 1e-6;     // the same in files of few digits
constexpr double kResisted = 1e-3;  // a motion that something resists

/// Sum of the work of unit translations, over that of all points apart.
double togetherOverApart(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(matrix.rows(), 3);
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) motions(row, row % 3) = 1;
  return (motions.transpose() * (matrix * motions)).trace() / matrix.trace();
}

/// How a matrix answers to translations, over how it answers to as large random vectors.
double answerToTranslations(const GivenMatrix& matrix, const std::vector<int>& components) {
  std::mt19937 random(1);
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(matrix.size(), 3), signs = motions;
  for (std::size_t row = 0; row < components.size(); ++row)
    if (components[row] >= 0 && components[row] < 3) {
      motions(row, components[row]) = 1;
      signs(row, components[row]) = random() % 2 ? 1 : -1;
    }
  return matrix.times(motions).norm() / matrix.times(signs).norm();
}

/// That a piece of the surface cannot move while the others and the fixed points stay in place.
void requireHeldPiece(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& free,
                      const Eigen::VectorXi& pieces, int piece, bool hasFixed, bool isNowhereHeld,
                      std::vector<std::string>& warnings) {
  std::vector<int> points, rows;
  for (int i = 0; i < pieces.size(); ++i)
    if (pieces[i] == piece) {
      points.push_back(i);
      for (int c = 0; c < 3; ++c) rows.push_back(3 * i + c);
    }
  if (points.empty()) return;
  const RigidMotions held = rigidMotions(stiffness(rows, rows), free(Eigen::all, points));
  const double least = held.shares[0];
  if (least < kFree || isNowhereHeld)
    refuse(hasFixed ? "the stiffness and the fixed vertices leave" : "the stiffness leaves",
           " the body free to move (", held.weakest.describe(),
           "): fix at least three vertices that are not on one line, or import it as unsupported");
  if (least < kLoose)
    warnings.push_back(sentence(
        "the body is held weakly (", held.weakest.describe(), " costs ", least,
        " of the work of its points by themselves): where the file has few digits, that is "
        "rounding"));
}

std::vector<int> componentsOf(const NodePlaces& places) {
  std::vector<int> components;
  for (const MatrixDof& dof : places.dofs) components.push_back(dof.component);
  return components;
}

}  // namespace

void requireOrder(const GivenMatrix& stiffness, const NodePlaces& places, DofOrder order) {
  if (!stiffness.dofs.empty() || answerToTranslations(stiffness, componentsOf(places)) < kLoose)
    return;
  const bool isByNode = order == DofOrder::ByNode;
  std::vector<int> others(stiffness.size());
  for (int row = 0; row < stiffness.size(); ++row)
    others[row] = isByNode ? row / (stiffness.size() / 3) : row % 3;
  if (answerToTranslations(stiffness, others) < kLoose)
    refuse("the rows of the stiffness are in another order: only with ",
           isByNode ? "all x before all y and z" : "x, y and z of each node together",
           " does it not resist translations, as a loose body's");
}

void requireHeld(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& free,
                 const Eigen::VectorXi& pieces, const Eigen::Matrix3Xd& fixed,
                 std::vector<std::string>& warnings) {
  Eigen::Matrix3Xd all(3, free.cols() + fixed.cols());
  all << free, fixed;
  for (Eigen::Index row = 0; row < stiffness.rows(); ++row)
    if (!(stiffness(row, row) > 0))
      refuse("the stiffness of one node by itself is not positive (", stiffness(row, row),
             " N/m at (", all.col(row / 3).transpose(), "), ", "xyz"[row % 3], ")");
  const Eigen::VectorXd translated = rigidMotions(stiffness, all, false).shares,
                        moved = rigidMotions(stiffness, all).shares;
  const bool isLoose = translated.maxCoeff() < kLoose;
  if (isLoose && moved.maxCoeff() > kResisted)
    refuse(
        "the stiffness resists no translation, but rotations: its nodes are not where the "
        "surface has them, or not in this order");
  if (togetherOverApart(stiffness) > 2)
    warnings.push_back(
        "moved as a whole, the body resists more than all its points by themselves: is the matrix "
        "a compliance?");
  const bool isNowhereHeld = fixed.cols() == 0 && isLoose && moved.maxCoeff() < kLoose;
  for (int piece = 0; piece <= pieces.maxCoeff(); ++piece)
    requireHeldPiece(stiffness, free, pieces, piece, fixed.cols() > 0, isNowhereHeld, warnings);
}

void requireLoose(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& points) {
  const RigidMotions moved = rigidMotions(stiffness, points);
  if (moved.shares.maxCoeff() < kLoose) return;
  if (rigidMotions(stiffness, points, false).shares.maxCoeff() < kLoose)
    refuse(
        "the stiffness resists no translation, but rotations: its nodes are not where the "
        "surface has them, or not in this order");
  refuse("the stiffness resists rigid motions (by up to ", moved.shares.maxCoeff(),
         " of the work of its points by themselves): the body is held where the matrix is from, "
         "and not unsupported");
}

void requireNoStiffness(const GivenMatrix& compliance, const NodePlaces& places) {
  if (answerToTranslations(compliance, componentsOf(places)) < kLoose)
    refuse(
        "the compliance answers nothing to a body's translation: it is the stiffness of a loose "
        "body, import it as one");
}

Negativity requireCompliance(const Eigen::MatrixXd& compliance, double defect,
                             std::vector<std::string>& warnings, const Progress& progress) {
  constexpr double rounding = 1e-12, fewDigits = 1e-6;
  if (togetherOverApart(compliance) < 0.5)
    warnings.push_back(
        "under forces on all points the body yields less than under those on each: is the matrix a "
        "stiffness?");
  Negativity negative = negativity((compliance + compliance.transpose()) / 2, rounding, progress);
  if (negative.share == 0 || negative.share > std::max(fewDigits, defect)) return negative;
  warnings.push_back(sentence("the compliance is not positive: its least eigenvalue is ",
                              negative.value, " m/N, -", negative.share, " of the largest"));
  return {};
}

double apparentModulus(const Eigen::MatrixXd& compliance, double size) {
  const double count = compliance.rows() / 3;
  const double yielding = togetherOverApart(compliance) * compliance.trace() / (3 * count * count);
  const double modulus = 1 / (yielding * size);
  if (!(modulus > 1e-60 && modulus < 1e60))
    refuse("forces on all points of the body move it by ", yielding,
           " m/N, which no elastic body does");
  return modulus;
}

double looseModulus(const Eigen::MatrixXd& compliance, double edge) {
  return compliance.rows() / (compliance.trace() * edge);
}

void warnOfUnits(double modulus, std::vector<std::string>& warnings) {
  if (isPlausibleModulus(modulus)) return;
  warnings.push_back(sentence("a body of this size and compliance has a Young's modulus of about ",
                              modulus,
                              " Pa, which no material has: state the units of the matrix"));
}

}  // namespace palpate::imported
