// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "imported/given_matrix.h"

namespace palpate {

/// What of a file a matrix is read from, where the file leaves it open.
struct MatrixFileOptions {
  std::string name;     ///< of several DMIG matrices
  std::string mapping;  ///< path of a mapping file as Ansys' HBMAT writes it, empty for none
};

/// Reads a square matrix, its format told by its content:
/// - NumPy's .npy: see readNumpy;
/// - Matrix Market: see readMatrixMarket;
/// - Harwell-Boeing, as Ansys' HBMAT: see readHarwellBoeing;
/// - NASTRAN's bulk data, DMIG: see readDmig;
/// - else text: a row a line, its numbers between ';', ',' or blanks, lines that begin with '#' and
///   a heading without any number passed over.
/// Sizes are held against the file's length before memory is taken for them.
/// @throws std::runtime_error that names the file if it cannot be read, std::invalid_argument that
///         names file and line for what it says wrongly.
GivenMatrix readMatrixFile(const std::string& path, const MatrixFileOptions& options = {});

/// Reads places of nodes: .npy or text as above with three columns (x, y, z) or four (number, x, y,
/// z), or the GRID cards of NASTRAN's bulk data.
/// @throws as above, and for numbers that are no positive whole ones or stand twice.
NodeTable readNodeFile(const std::string& path);

/// Nodes of a table of three or four columns.
/// @param name  for sentences.
NodeTable nodesOf(const Eigen::MatrixXd& table, const std::string& name);

}  // namespace palpate
