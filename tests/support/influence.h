// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "bem/influence_panels.h"

namespace palpate::test {

/// H and G as whole matrices, rows by equation.
struct InfluenceMatrices {
  Eigen::MatrixXd h, g;  ///< 3 #equations by 3 #v, by 3 #traction nodes

  InfluenceMatrices(const bem::BodySurface& body, const bem::CollocationScheme& scheme,
                    double tolerance) {
    const bem::InfluencePanels panels(body, scheme, tolerance);
    bem::InfluencePanels::Workspace work(panels);
    h.resize(3 * scheme.equationCount(), 3 * body.vertexCount());
    g.resize(3 * scheme.equationCount(), 3 * body.nodes.count());
    for (int panel = 0; panel < panels.panelCount(); ++panel) {
      panels.compute(panel, work);
      for (int lane = 0; lane < panels.laneCount(panel); ++lane)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            const int row = 3 * (panel * bem::kLanes + lane) + i;
            for (int v = 0; v < body.vertexCount(); ++v) h(row, 3 * v + j) = work.h(v, i, j)[lane];
            for (int node = 0; node < body.nodes.count(); ++node)
              g(row, 3 * node + j) = work.g(node, i, j)[lane];
          }
    }
  }
};

}  // namespace palpate::test
