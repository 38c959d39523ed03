// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <string_view>

#include "imported/given_matrix.h"

namespace palpate::imported {

/// Whether there is a line of this card among NASTRAN's bulk data, in small, large or free fields.
bool hasCard(std::string_view bytes, std::string_view name);

/// A real matrix of DMIG cards with the grid points that the file has of it (MSC Nastran Quick
/// Reference Guide, "DMIG" and "GRID"): square (form 1), symmetric (6), or rectangular (2, 9) if
/// its columns are its rows. Component 0 stands for scalar points, 1 to 6 for those of grid points.
/// @param name  of the matrix; empty for the only one, or the only one whose name begins with K.
/// @throws std::invalid_argument naming the line for anything else, and for grid points in frames
///         of their own.
GivenMatrix readDmig(std::string_view bytes, const std::string& path, const std::string& name);

/// The places of all GRID cards.
/// @throws as above.
NodeTable readGridPoints(std::string_view bytes, const std::string& path);

}  // namespace palpate::imported
