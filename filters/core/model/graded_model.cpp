// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/graded_model.h"

#include "mesh/rim_grading.h"

namespace palpate {

ElasticModel gradedModel(const ElasticModel& model, int layers) {
  const std::vector<unsigned char>& types = model.conditions().types();
  const GradedSurface graded = gradeTowardsSupport(model.mesh(), types, layers);
  return ElasticModel(
      std::make_shared<SurfaceMesh>(graded.points, graded.triangles, model.mesh().rims()),
      model.material(), BoundaryConditions(gradedBoundaryTypes(graded, types)),
      gradedSmoothPatches(graded, model.smoothPatches()), model.domain());
}

}  // namespace palpate
