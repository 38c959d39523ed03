// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/scene_settings.h"

#include "haptics/json_reader.h"

namespace palpate {
namespace {

constexpr double kFarthest = 1e6;  ///< m, and as large as other numbers get

}  // namespace

ServoSettings readServo(JsonSection& section) {
  ServoSettings servo;
  readIf(section, "rate", [&](const Json& found, const std::string& at) {
    servo.rate = readPositive(found, at, 10000);
    if (servo.rate < 250) refuseKey(at, "must be a number from 250 to 10000, not " + shown(found));
  });
  readIf(section, "budget", servo.budget, readPositive, 1);
  readIf(section, "snapshot_ticks", servo.snapshotTicks, readInteger, 1, 10000);
  readIf(section, "passivity_damping", servo.passivityDamping, readNotNegative, kFarthest);
  readIf(section, "real_time", servo.realTime, readFlag);
  readIf(section, "processor", servo.processor, readInteger, 0, 4095);
  section.requireNothingElse();
  return servo;
}

SafetySettings readSafety(JsonSection& section) {
  SafetySettings safety;
  readIf(section, "largest_force", safety.largestForce, readNotNegative, kFarthest);
  readIf(section, "largest_torque", safety.largestTorque, readNotNegative, kFarthest);
  readIf(section, "force_slew", safety.forceSlew, readPositive, 1e9);
  readIf(section, "torque_slew", safety.torqueSlew, readPositive, 1e9);
  readIf(section, "ramp_seconds", safety.rampSeconds, readPositive, 60);
  section.requireNothingElse();
  return safety;
}

UnilateralContactSettings readSolver(JsonSection& section) {
  UnilateralContactSettings solver;
  readIf(section, "capacity", solver.capacity, readInteger, 1,
         UnilateralContactSettings::kMostContacts);
  readIf(section, "margin", solver.margin, readNotNegative, kFarthest);
  readIf(section, "linearisations", solver.linearisations, readInteger, 1, 20);
  readIf(section, "tolerance", solver.solver.tolerance, readPositive, 1);
  readIf(section, "largest_iterations", solver.solver.largestIterations, readInteger, 1, 1000000);
  readIf(section, "largest_updates", [&](const Json& found, const std::string& at) {
    solver.solver.largestUpdates = readInteger(found, at, 0, 1000000);
    if (solver.solver.largestUpdates == 0)
      refuseKey(at,
                "must be at least 1: without a limit the servo loop would wait for LAPACK, which "
                "allocates and locks; leave it out for the default, 12");
  });
  readIf(section, "largest_work", solver.solver.largestWork, readPositive, 1e15);
  section.requireNothingElse();
  return solver;
}

}  // namespace palpate
