// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// Where the boundary integral equation is enforced.
enum class Collocation {
  Averaged,  ///< its mean under each vertex's hat, and global equilibrium: no bias of curved fields
  Vertex,    ///< at the vertices alone, as in [JP01]: a third of the integration work
};

}  // namespace palpate
