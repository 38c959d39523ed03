// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "held_arrays.h"

#include "array_names.h"
#include "fem/finite_element_method.h"
#include "fingerprint_arrays.h"
#include "sentence.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace palpate::convert
{
HeldDisplacements heldDisplacementsOf(vtkPolyData* surface, const BoundaryConditions& conditions)
{
  vtkDataArray* array = surface->GetPointData()->GetArray(arrays::HeldComponents);
  if (!array)
  {
    return {};
  }
  const int components = array->GetNumberOfComponents();
  if (components != 3 && components != 6)
  {
    refuse("the point array '", arrays::HeldComponents,
      "' must have 3 components, or 6 of which a solid's are the first three, not ", components);
  }
  HeldDisplacements held = HeldDisplacements::Constant(3, conditions.nodeCount(), false);
  for (int v : conditions.freeNodes())
  {
    for (int k = 0; k < 3; ++k)
    {
      const double value = array->GetComponent(v, k);
      if (value != 0 && value != 1)
      {
        refuse("held component ", k, " of vertex ", v, " must be 0 or 1, not ", value);
      }
      held(k, v) = value != 0;
    }
  }
  return held.any() ? held : HeldDisplacements();
}

void readHeldArrays(vtkPolyData* surface, GreensFunctionsInfo& info)
{
  const HeldDisplacements held = heldDisplacementsOf(surface, info.conditions);
  const std::uint64_t with = heldFingerprint(held, info.fingerprint);
  if (held.any() && storedFingerprint(surface) == with)
  {
    info.fingerprint = with; // others may carry the array for what is made of them
  }
}
} // namespace palpate::convert
