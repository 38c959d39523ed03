// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "report/measured_data.h"
#include "report/report_option.h"

class vtkPolyData;

/// Parts of the pages of identifications, as HTML.
namespace palpate::app {

/// A component of a field array's tuple.
double fieldComponentAt(vtkPolyData* model, const char* name, std::size_t tuple, int component = 0);

/// Three numbers in brackets.
std::string vectorIn(const Eigen::Vector3d& vector, int digits = 4);

/// How the table's frame was moved onto the surface, with deviations: the turn as a vector,
/// degrees, and the shift, m. Nothing where it was not.
struct RegistrationText {
  std::string turn, shift;
};
RegistrationText registrationText(vtkPolyData* model);

/// What the registration has of the deviations.
std::string registrationShareText(vtkPolyData* model);

/// By how much the mesh makes parameters too large, where that was estimated; else nothing.
std::string offByMeshText(vtkPolyData* model);

/// How residuals of neighbouring markers under one probe go together.
std::string neighboursText(vtkPolyData* model);
/// Whether more than noise does, so that deviations are too small.
bool lacksFit(vtkPolyData* model);

/// What was identified, with deviations and intervals; where the fit lacks, with those by probes
/// left out, too.
std::string parameterTable(vtkPolyData* model);
/// Nothing for a single parameter.
std::string correlationTable(vtkPolyData* model);
std::string probeTable(const MeasuredData& data);
/// @param rowWord  what counts the measurements: line, tuple.
std::string outlierTable(const MeasuredData& data, const std::string& rowWord);
/// Nothing where none was asked for.
std::string proposalTable(vtkPolyData* model);
/// Fingerprint, method, settings, seconds.
std::string provenance(vtkPolyData* model, const RunDescription& run);
/// Items of a list; nothing for none.
std::string listOf(const std::vector<std::string>& sentences);

/// The last part of a path.
std::string fileName(const std::string& path);

}  // namespace palpate::app
