// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/richardson.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr double kLeastOrder = 0.5, kLargestOrder = 4;
constexpr double kOrderWithoutTrend = 1;

Eigen::VectorXd limitOf(const Eigen::VectorXd& coarse, const Eigen::VectorXd& fine, double order) {
  return fine + (fine - coarse) / (std::exp2(order) - 1);
}

}  // namespace

RichardsonExtrapolation extrapolate(const std::vector<Eigen::VectorXd>& answers,
                                    const std::function<double(const Eigen::VectorXd&)>& norm,
                                    double statedOrder) {
  const std::size_t count = answers.size();
  if (count < 2)
    throw std::invalid_argument("an extrapolation takes two answers or more, not " +
                                std::to_string(count));
  for (const Eigen::VectorXd& answer : answers)
    if (answer.size() != answers.front().size())
      throw std::invalid_argument("answers of " + std::to_string(answers.front().size()) + " and " +
                                  std::to_string(answer.size()) +
                                  " numbers are not of one question");
  const Eigen::VectorXd &fine = answers[count - 1], &middle = answers[count - 2];
  RichardsonExtrapolation result;
  result.order = statedOrder;
  const double last = norm(fine - middle);
  if (count == 2 || last == 0) {
    result.values = limitOf(middle, fine, result.order);
    result.uncertainty = norm(result.values - fine);
    return result;
  }
  const Eigen::VectorXd& coarse = answers[count - 3];
  const double order = std::log2(norm(middle - coarse) / last);
  result.isObserved = order >= kLeastOrder && order <= kLargestOrder;
  result.order = result.isObserved ? order : kOrderWithoutTrend;
  result.values = limitOf(middle, fine, result.order);
  result.uncertainty = last;
  if (!result.isObserved) return result;
  const Eigen::VectorXd apart = result.values - limitOf(coarse, middle, order);
  result.uncertainty =
      std::max(norm(apart) / (std::exp2(order) - 1), 0.25 * norm(result.values - fine));
  return result;
}

}  // namespace palpate
