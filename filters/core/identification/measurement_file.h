// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "identification/measurements.h"

namespace palpate {

/// Units that a table is in.
struct MeasurementUnits {
  double length = 1;  ///< m
  double force = 1;   ///< N
};

/// Reads a table of measurements: a line of names, then a line for each displacement, its words
/// between `,` or `;` or blanks, in quotation marks or not, names in capitals or not; lines that
/// begin with # are passed over.
///
/// | name                                       | what                                          |
/// |--------------------------------------------|-----------------------------------------------|
/// | probe                                      | which probe, any word                         |
/// | contact_vertex, or contact_x, _y, _z       | where it presses, at rest                     |
/// | radius                                     | of the mask of its force; 0 if there is none  |
/// | force_x, force_y, force_z                  | on the body                                   |
/// | vertex, or x, y, z                         | the marker's place at rest                    |
/// | u_x, u_y, u_z                              | its displacement; empty where not measured    |
/// | sd, or sd_x, sd_y, sd_z                    | standard deviation of these; optional         |
///
/// What belongs to the probe is the same in all of its lines, or empty in all but the first.
/// Lengths are in the unit of length, forces in that of force. Between blanks no word can be empty.
/// @throws std::invalid_argument that begins with the file and the line; std::runtime_error that
///         begins with the file if it cannot be read; as requireSound.
Measurements readMeasurementFile(const std::string& path, const MeasurementUnits& units = {});

/// Reads such a table of what moves under unknown contacts: columns of forces, contacts and radii
/// may be missing and are passed over, and without the column `probe` all is of one.
/// @param length  unit of the table, m.
/// @throws as readMeasurementFile.
Measurements readObservationFile(const std::string& path, double length = 1);

/// Writes such a table, in metres and newtons, so that it reads back bit by bit;
/// without forces also without contacts and radii.
/// @throws std::runtime_error that begins with `path` if it cannot be written.
void writeMeasurementFile(const std::string& path, const Measurements& measurements);

}  // namespace palpate
