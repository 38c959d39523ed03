// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkMaskedContactAlgorithm.h"

#include "contact/mask_settings.h"

void vtkMaskedContactAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mask: " << this->Mask << "\n"
     << indent << "Distance: " << this->Distance << "\n"
     << indent << "Radius: " << this->Radius << "\n"
     << indent << "RadiusInEdgeLengths: " << this->RadiusInEdgeLengths << "\n";
}

palpate::MaskSettings vtkMaskedContactAlgorithm::Settings(double meanEdgeLength) const
{
  return { static_cast<palpate::MaskKind>(this->Mask),
    this->RadiusInEdgeLengths ? this->Radius * meanEdgeLength : this->Radius,
    static_cast<palpate::MaskDistance>(this->Distance) };
}
