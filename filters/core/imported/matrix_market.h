// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <string_view>

#include "imported/given_matrix.h"

namespace palpate::imported {

bool isMatrixMarket(std::string_view bytes);

/// A Matrix Market file (R. F. Boisvert, R. Pozo, K. A. Remington, "The Matrix Market exchange
/// formats", NISTIR 5935, 1996): array or coordinate, real or integer, general or symmetric.
/// @throws std::invalid_argument naming the line for anything else.
GivenMatrix readMatrixMarket(std::string_view bytes, const std::string& path);

}  // namespace palpate::imported
