// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/compute_greens.h"

#include <algorithm>

#include "accuracy/tetrahedra.h"
#include "greens/dense_greens_functions.h"
#include "halfspace/half_space_greens_functions.h"
#include "shell/shell_greens_functions.h"

namespace palpate::app {
namespace {

ComputedGreensFunctions byBoundaryElements(const ElasticModel& model, const Query& query,
                                           const Setting& setting, int threads,
                                           const ProgressCallback& progress) {
  BoundaryElementOptions options;
  options.precision = setting.precision;
  options.solver = setting.solver;
  options.collocation = setting.collocation;
  options.tolerance = setting.tolerance;
  options.reciprocal = setting.reciprocal;
  options.columns = query.columns(setting);
  options.patchColumns = query.usesPatchColumns();
  options.threads = threads;
  return computeBoundaryElementGreensFunctions(model, options, progress);
}

ComputedGreensFunctions matrixOf(const BodyLevels& body, const Query& query, const Setting& setting,
                                 int threads, const ProgressCallback& progress) {
  const ElasticModel model = body.model(setting.level, setting.jumps);
  switch (setting.method) {
    case Method::ThinShell:
      return computeShellGreensFunctions(model, body.shell(setting.level, model),
                                         {query.columns(setting), setting.reciprocal}, progress);
    case Method::QuadraticTetrahedra:
    case Method::LinearTetrahedra: {
      const SolidElement element = setting.method == Method::LinearTetrahedra
                                       ? SolidElement::Linear
                                       : SolidElement::Quadratic;
      if (body.isFilled())
        return greensOfFilling(model, body.filling(setting.level), element, setting.reciprocal,
                               query.columns(setting), progress);
      return greensByTetrahedra(model, element, setting.reciprocal, query.columns(setting),
                                progress);
    }
    default:
      return byBoundaryElements(model, query, setting, threads, progress);
  }
}

AlignedBuffer<float> rounded(const AlignedBuffer<double>& matrix, std::size_t count) {
  AlignedBuffer<float> result(count);
  std::copy_n(matrix.data(), count, result.data());
  return result;
}

}  // namespace

MadeGreens computeGreens(const BodyLevels& body, const Query& query, const Setting& setting,
                         int threads, bool wantsFloat, const ProgressCallback& progress,
                         const std::function<void()>& made) {
  MadeGreens result;
  if (setting.method == Method::HalfSpace) {
    const auto greens =
        computeHalfSpaceGreensFunctions(body.model(setting.level, setting.jumps),
                                        {setting.reciprocal, query.columns(setting)}, progress);
    if (made) made();
    result.peakBytes = result.bytes = greens->bytes();
    result.greens = greens;
    return result;
  }
  ComputedGreensFunctions computed = matrixOf(body, query, setting, threads, progress);
  if (made) made();
  result.peakBytes = computed.info.diagnostics.peakBytes;
  const std::size_t rows = 3 * std::size_t(body.mesh(setting.level).vertexCount()),
                    own = 3 * rows * computed.info.columnNodes.size(),
                    patch = 3 * rows * computed.info.patchColumns.size();
  result.floatBytes = sizeof(float) * (own + patch);
  result.bytes = setting.precision == Precision::Float ? result.floatBytes : 2 * result.floatBytes;
  if (wantsFloat)
    result.asFloat = std::make_shared<DenseGreensFunctions<float>>(
        computed.info, rounded(computed.matrix, own), rounded(computed.patchMatrix, patch));
  result.greens = computed.take();
  return result;
}

}  // namespace palpate::app
