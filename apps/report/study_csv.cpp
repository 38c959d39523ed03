// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/csv.h"
#include "report/stiffness_study.h"

namespace palpate::app {

using csv::field;
using csv::quoted;

std::string studyCsv(const StiffnessStudy& study) {
  std::string text =
      "mesh,level,vertices,mean_edge_m,vertex_size_m,point_offset_m,single_norm_N_per_m,"
      "masked_norm_N_per_m,single_compliance_m_per_N,area_correlation_single,"
      "area_correlation_masked,variation_single,variation_masked,largest_jump_single,"
      "largest_jump_masked,change_median_single,change_median_masked,change_95th_single,"
      "change_95th_masked\n";
  for (const PointSample& point : study.points) {
    text += quoted(point.name) + "," + (point.level > 0 ? std::to_string(point.level) : "") + "," +
            std::to_string(point.vertices);
    for (double value :
         {point.edge, point.size, point.apart, point.single, point.masked, point.compliance})
      text += field(value);
    const MeshStudy* mesh = nullptr;
    for (const MeshStudy& each : study.meshes)
      if (each.name == point.name) mesh = &each;
    const auto both = [&](const char* name, int component) {
      for (bool isMasked : {false, true})
        text += mesh ? field(fieldComponent(isMasked ? mesh->masked : mesh->bare, name, component))
                     : ",";
    };
    both("ArtifactAreaCorrelation", 1);
    both("ArtifactVariation", 1);
    both("ArtifactLargestJump", 1);
    both("StiffnessChangeMeasures", 0);
    both("StiffnessChangeMeasures", 2);
    text += "\n";
  }
  return text;
}

}  // namespace palpate::app
