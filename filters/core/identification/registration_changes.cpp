// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/registration_changes.h"

#include <array>
#include <Eigen/Geometry>
#include <map>
#include <stdexcept>
#include <vector>

namespace palpate {
namespace {

constexpr double kSteps[] = {1, 0.25, 0.0625};  // of a standard deviation
constexpr double kMostWork = 5e7;               // of a fit: rows times columns squared

using ResidualsOf = std::function<Eigen::VectorXd(const Measurements& moved)>;

/// By a standard deviation. @param at  the measurements at so many of them.
Eigen::VectorXd centralDifference(const std::function<Measurements(double)>& at,
                                  const ResidualsOf& residuals) {
  for (double step : kSteps) try {
      return (residuals(at(step)) - residuals(at(-step))) / (2 * step);
    } catch (const std::invalid_argument&) {
      if (step == kSteps[2]) throw;
    }
  return {};
}

/// The number of each displacement's marker: the same place under several probes is one.
std::vector<int> markerNumbers(const Measurements& measurements, int& count) {
  std::map<std::array<double, 3>, int> known;
  std::vector<int> numbers;
  for (const MeasuredDisplacement& measured : measurements.displacements) {
    const Eigen::Vector3d& p = measured.marker.point;
    numbers.push_back(
        measured.marker.vertex >= 0
            ? -1
            : known.emplace(std::array{p.x(), p.y(), p.z()}, int(known.size())).first->second);
  }
  count = static_cast<int>(known.size());
  return numbers;
}

/// Sets a column a number: where rows have it, their part of a change of all.
void split(const Eigen::VectorXd& change, const std::vector<int>& numbers,
           Eigen::Ref<Eigen::MatrixXd> columns) {
  columns.setZero();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= 0) columns.block<3, 1>(3 * i, numbers[i]) = change.segment<3>(3 * i);
}

/// All contacts, or all markers, along an axis.
Measurements shifted(Measurements measurements, bool contacts, int axis, double by) {
  const auto shift = [&](RestPlace& place) { place.point[axis] += by; };
  if (contacts)
    for (Probe& probe : measurements.probes) shift(probe.contact);
  else
    for (MeasuredDisplacement& measured : measurements.displacements) shift(measured.marker);
  return measurements;
}

bool isTooMuch(double rows, double columns) {
  return rows * columns * columns > kMostWork;
}

}  // namespace

Registration moved(const Registration& registration, const Eigen::Matrix<double, 6, 1>& motion) {
  const double angle = motion.head<3>().norm();
  const Eigen::Matrix3d turn =
      angle > 0 ? Eigen::AngleAxisd(angle, motion.head<3>() / angle).toRotationMatrix()
                : Eigen::Matrix3d::Identity().eval();
  Registration result = registration;
  result.rotation = turn * registration.rotation;
  result.centre = registration.centre + motion.tail<3>();
  result.translation = turn * (registration.translation - registration.centre) + result.centre;
  return result;
}

Eigen::MatrixXd changesByRegistration(const Measurements& measurements,
                                      const Registration& registration,
                                      const ResidualsOf& residuals) {
  const Eigen::Index rows = 3 * measurements.displacements.size();
  int markers;
  const std::vector<int> markerOf = markerNumbers(measurements, markers);
  std::vector<int> probeOf;
  for (const MeasuredDisplacement& measured : measurements.displacements)
    probeOf.push_back(measured.probe);
  int probes = static_cast<int>(measurements.probes.size());
  if (isTooMuch(rows, 6 + 3 * (markers + probes))) markers = 0;
  if (isTooMuch(rows, 6 + 3 * probes)) probes = 0;
  Eigen::MatrixXd changes(rows, 6 + 3 * (probes + markers));
  Registration here;  // from the surface's frame
  here.centre = registration.centre;
  for (int motion = 0; motion < 6; ++motion)
    changes.col(motion) = centralDifference(
        [&](double step) {
          return registered(measurements, moved(here, step * registration.spread.col(motion)));
        },
        residuals);
  Eigen::Index next = 6;
  const auto addPlaces = [&](bool contacts, const std::vector<int>& numbers, int count) {
    for (int axis = 0; axis < 3 && count > 0; ++axis, next += count)
      split(centralDifference(
                [&](double step) {
                  return shifted(measurements, contacts, axis, step * registration.placeDeviation);
                },
                residuals),
            numbers, changes.middleCols(next, count));
  };
  addPlaces(true, probeOf, probes);
  addPlaces(false, markerOf, markers);
  return changes;
}

}  // namespace palpate
