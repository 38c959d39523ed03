// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_fingerprint_arrays_h
#define palpate_fingerprint_arrays_h

#include <cstdint>

class vtkPolyData;

/// What the Green's functions that a surface carries were computed for. Not for wrapping.
namespace palpate::convert
{
/// 0 without a usable array MeshFingerprint.
std::uint64_t storedFingerprint(vtkPolyData* surface);

/// @throws std::invalid_argument unless that is it.
void requireFingerprint(vtkPolyData* surface, std::uint64_t expected);
} // namespace palpate::convert

#endif
