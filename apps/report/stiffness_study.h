// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

#include "contact/stiffness_artifacts.h"
#include "terminal.h"

namespace palpate::app {

/// What a study of one object's meshes is asked for.
struct StudyOptions {
  std::vector<std::string> inputs;  ///< models, or one surface with support and material
  std::vector<int> levels;          ///< of Loop's hierarchy over the surface, 1 as it is
  std::vector<int> tableLevels;     ///< beyond them, at the point alone
  std::vector<double> edgeLengths;  ///< of remeshings of the finest level
  std::vector<double> point;        ///< where tables and point loads are; empty: see farthestPoint
  double smoothingLength = 0;       ///< m, 0 for a tenth of the diagonal
  std::string precision = "double";
  MaskOptions mask;
};

/// A mesh at the point that the study looks at.
struct PointSample {
  std::string name;
  int level = 0;  ///< of the hierarchy, 0 for others
  int vertices = 0;
  double edge = 0, size = 0,
         apart = 0;               ///< mean edge; root of the vertex's area; from the point; m
  double single = 0, masked = 0;  ///< |K|_F, N/m
  double compliance = 0;          ///< |K^-1|_F of the single vertex, m/N
  double maskedCompliance = 0;    ///< under the mask
};

/// A mesh with its fields.
struct MeshStudy {
  std::string name;
  int level = 0;
  int free = 0;
  double edge = 0;                            ///< mean, m
  vtkSmartPointer<vtkPolyData> bare, masked;  ///< of vtkStiffnessArtifacts, without and with mask
};

/// Meshes of one object, compared under one mask and smoothing length.
struct StiffnessStudy {
  std::vector<MeshStudy> meshes;           ///< by mean edge, the coarsest first
  std::vector<PointSample> points;         ///< likewise, more of them
  std::array<double, 3> point;             ///< m
  double radius = 0, smoothingLength = 0;  ///< m
  bool hasLaw = false;                     ///< three levels or more
  PointSingularity law;                    ///< of the hierarchy's points, or of all
};

/// @throws std::invalid_argument or std::runtime_error with a sentence.
StiffnessStudy studyStiffness(const StudyOptions& options);

/// The two numbers of a field array of vtkStiffnessArtifacts.
double fieldComponent(vtkPolyData* surface, const char* name, int component);

/// Pictures and text of a study, as one page.
std::string studyPage(const StiffnessStudy& study, const StudyOptions& options);

/// The tables of a study, a line a mesh.
std::string studyCsv(const StiffnessStudy& study);

}  // namespace palpate::app
