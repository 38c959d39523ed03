// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkMaskedContactAlgorithm.h"

void vtkMaskedContactAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mask: " << this->Mask << "\n"
     << indent << "Radius: " << this->Radius << "\n"
     << indent << "RadiusInEdgeLengths: " << this->RadiusInEdgeLengths << "\n";
}
