// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <mutex>

/// A stand-in for a vendor's library of an arm, in the manner of those: C functions, handles,
/// millimetres, matrices by rows, error codes. Behind it is one arm, which tests move.
namespace stand_in_sdk {

struct Arm {
  std::mutex mutex;
  bool isPlugged = true;
  double millimetres[3] = {0, 0, 0};
  double matrix[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  unsigned buttons = 0;
  double newtons[3] = {0, 0, 0};
  int openHandles = 0;
};

inline Arm& arm() {
  static Arm arm;
  return arm;
}

/// @return a handle, or -1.
inline int armOpen() {
  const std::lock_guard<std::mutex> lock(arm().mutex);
  return arm().isPlugged ? arm().openHandles++ : -1;
}

inline void armClose(int) {
  const std::lock_guard<std::mutex> lock(arm().mutex);
  --arm().openHandles;
}

/// @return 0, or -1 if the arm is gone.
inline int armGetPose(int, double* millimetres, double* matrix, unsigned* buttons) {
  const std::lock_guard<std::mutex> lock(arm().mutex);
  if (!arm().isPlugged) return -1;
  for (int i = 0; i < 3; ++i) millimetres[i] = arm().millimetres[i];
  for (int i = 0; i < 9; ++i) matrix[i] = arm().matrix[i];
  *buttons = arm().buttons;
  return 0;
}

inline int armSetForce(int, const double* newtons) {
  const std::lock_guard<std::mutex> lock(arm().mutex);
  if (!arm().isPlugged) return -1;
  for (int i = 0; i < 3; ++i) arm().newtons[i] = newtons[i];
  return 0;
}

}  // namespace stand_in_sdk
