// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_recovery_arrays_h
#define palpate_recovery_arrays_h

#include "identification/contact_recovery.h"

class vtkPolyData;

namespace palpate::convert
{
/// Adds what was recovered from displacements (see array_names.h), in place of any contact. Not for
/// wrapping.
/// @param places, displacements  3 by #points: where, and what was observed.
void setRecovery(vtkPolyData* surface, const ContactRecovery& recovery, const Eigen::Matrix3Xd& places,
  const Eigen::Matrix3Xd& displacements);
} // namespace palpate::convert

#endif
