// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// Whether a surface may end: at rims, chains of edges that belong to one triangle alone.
enum class Rims {
  Refused,  ///< it bounds bodies: closed, normals out of the material
  Allowed,  ///< it is a sheet, oriented, whose normals say which side is outside
};

}  // namespace palpate
