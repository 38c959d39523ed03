// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fingerprint_arrays.h"

#include "array_names.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"

#include <cstring>
#include <stdexcept>

namespace palpate::convert
{
std::uint64_t storedFingerprint(vtkPolyData* surface)
{
  // Readers give any of the 64-bit integer classes.
  vtkDataArray* array = surface->GetFieldData()->GetArray(arrays::MeshFingerprint);
  std::uint64_t stored = 0;
  if (array && array->GetNumberOfValues() == 1 && array->GetDataTypeSize() == sizeof stored &&
    array->HasStandardMemoryLayout())
  {
    std::memcpy(&stored, array->GetVoidPointer(0), sizeof stored);
  }
  return stored;
}

void requireFingerprint(vtkPolyData* surface, std::uint64_t expected)
{
  if (storedFingerprint(surface) != expected)
  {
    throw std::invalid_argument(
      "the Green's functions are stale: points, triangles, boundary types, smooth patches or "
      "Poisson's ratio (held components and a shell's thickness, too) have changed since they were "
      "computed; compute them again");
  }
}
} // namespace palpate::convert
