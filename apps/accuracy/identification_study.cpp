// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/identification_study.h"

#include <measurement_arrays.h>
#include <model_arrays.h>
#include <probed_surface.h>
#include <read_files.h>
#include <vtkComplianceCorrection.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkReferenceBoundaryConditions.h>
#include <vtkRigSimulation.h>
#include <vtkSolidBoundary.h>
#include <vtkStiffnessFieldIdentification.h>
#include <vtkSurfaceRefinement.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "accuracy/identification_knobs.h"
#include "accuracy/timing.h"
#include "file_kinds.h"
#include "process_memory.h"
#include "subdivision_option.h"
#include "terminal.h"

namespace palpate::app {
namespace {

/// Of diagonals: coarse levels lie off the truth's surface.
constexpr double kPlaceTolerance = 0.1;
constexpr int kOtherProbes = 12, kOtherMarkers = 60, kOtherSeed = 1000;
constexpr int kLeastRuns = 2;

/// What was seen of a setting.
struct Outcome {
  std::vector<double> seconds, peakBytes;  ///< a run each
  double error = 0, spent = 0;
  int vertices = 0, columns = 0;
  std::size_t storedBytes = 0;
  std::string failure;
};

void requireSensible(const AccuracyOptions& o) {
  const auto require = [](bool isSensible, const std::string& sentence) {
    if (!isSensible) throw std::invalid_argument(sentence);
  };
  require(!o.rig.model.empty(),
          "say by --rig what is measured: a model of the same body, of another mesh or method");
  require(o.method == "bem" || o.method == "fem",
          "--query identification takes the methods bem and fem, not " + o.method);
  require(!isVolumeFile(o.input) || o.method == "fem",
          o.input + " is a volume mesh: add --method fem");
  require(o.reference.empty() && o.referenceLevel == 0,
          "the reference of --query identification is the model of --rig: leave --reference and "
          "--reference-level out");
  require(o.points.empty() && o.ballRadius == 0 && o.depth == 0 && o.thickness == 0 && !o.hinged,
          "--at, --ball-radius, --depth, --thickness and --hinged make no sense with --query "
          "identification: leave them out");
}

vtkSmartPointer<vtkPolyData> measured(vtkPolyData* truth, const AccuracyOptions& o,
                                      bool isReference) {
  vtkNew<vtkRigSimulation> rig;
  rig->SetInputData(truth);
  rig->SetNumberOfProbes(isReference ? kOtherProbes : o.rig.probes);
  rig->SetNumberOfMarkers(isReference ? kOtherMarkers : o.rig.markers);
  rig->SetRadius(o.radius);
  rig->SetNoise(isReference ? 0 : o.rig.noise);
  rig->SetOutliers(isReference ? 0 : o.rig.outliers);
  rig->SetSeed(isReference ? o.rig.seed + kOtherSeed : o.rig.seed);
  return run(rig);
}

/// Everything on the way from options to results.
class IdentificationRun {
 public:
  explicit IdentificationRun(const AccuracyOptions& options)
      : options_(options), levels_(options.levels) {
    std::sort(levels_.begin(), levels_.end());
    levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
    const auto truth = readSurface(options.rig.model);
    table_ = measured(truth, options, false);
    others_ = convert::measurementsOf(measured(truth, options, true));
    vtkNew<vtkReferenceBoundaryConditions> conditions;
    if (isVolumeFile(options.input)) {
      levels_ = {1};
      grid_ = readVolume(options.input);
      vtkNew<vtkSolidBoundary> boundary;
      boundary->SetInputData(grid_);
      conditions->SetInputData(run(boundary));
    } else {
      conditions->SetInputData(readSurface(options.input));
    }
    options.support.applyTo(conditions);
    conditions->SetYoungsModulus(1);  // what is identified takes its place
    conditions->SetPoissonRatio(0.3);
    const auto surface = run(conditions);
    for (int level : levels_) {
      vtkNew<vtkSurfaceRefinement> refinement;
      refinement->SetInputData(surface);
      refinement->SetNumberOfLevels(level - 1);
      refinement->SetSubdivision(static_cast<int>(subdivisionOf(options)));
      surfaces_[level] = run(refinement);
    }
    const std::size_t last = levels_.size() - 1;
    base_.level = options.baseLevel > 0 ? options.baseLevel : levels_[last > 0 ? last - 1 : 0];
    if (!surfaces_.count(base_.level))
      throw std::invalid_argument("--base-level is one of --levels, which have no level " +
                                  std::to_string(base_.level));
    base_.isFinite = options.method == "fem";
  }

  AccuracyStudy study() {
    const std::vector<IdentificationTrial> trials =
        identificationTrials(options_.knobs, base_, levels_, !grid_);
    std::map<decltype(base_.key()), Outcome> outcomes;
    for (int round = 0; round < options_.repeats; ++round) {
      std::map<decltype(base_.key()), bool> isRun;
      for (const IdentificationTrial& trial : trials) {
        Outcome& outcome = outcomes[trial.setting.key()];
        const bool isWithinBudget = outcome.spent * (round + 1) <= options_.budget * round;
        if (!outcome.failure.empty() || (round >= kLeastRuns && !isWithinBudget)) continue;
        if (!isRun.emplace(trial.setting.key(), true).second) continue;
        runOnce(trial.setting, outcome);
      }
    }
    AccuracyStudy result = described();
    for (const IdentificationTrial& trial : trials)
      result.results.push_back(resultOf(trial, outcomes.at(trial.setting.key())));
    markFront(result.results, true);
    return result;
  }

 private:
  static Subdivision subdivisionOf(const AccuracyOptions& options) {
    return options.subdivision.empty() ? Subdivision::Loop : subdivisionNamed(options.subdivision);
  }

  vtkSmartPointer<vtkPolyData> identified(const IdentificationSetting& setting) const {
    vtkNew<vtkStiffnessFieldIdentification> ofField;
    vtkNew<vtkGreensFunctionIdentification> ofMaterial;
    const bool isField = setting.fieldModes > 0;
    vtkGreensFunctionIdentification* const filter = isField ? ofField.Get() : ofMaterial.Get();
    if (isField) ofField->SetNumberOfModes(setting.fieldModes);
    filter->SetInputData(surfaces_.at(setting.level));
    if (grid_) filter->SetInputData(1, grid_);
    filter->SetInputData(2, table_);
    filter->SetMethod(setting.isFinite);
    filter->SetLoss(static_cast<int>(setting.loss));
    filter->SetInterpolationTolerance(setting.tolerance);
    filter->SetNumberOfFolds(0);
    filter->SetEstimateError(false);
    filter->SetPlaceTolerance(kPlaceTolerance);
    filter->SetNumberOfThreads(options_.threads);
    const auto model = run(filter);
    if (setting.correctionModes < 0) return model;
    vtkNew<vtkComplianceCorrection> correction;
    correction->SetInputData(model);
    correction->SetInputData(1, table_);
    correction->SetNumberOfModes(setting.correctionModes);
    correction->SetPlaceTolerance(kPlaceTolerance);
    return run(correction);
  }

  void runOnce(const IdentificationSetting& setting, Outcome& outcome) const {
    const bool isProcessor = options_.clock == "cpu";
    const double wall = wallSeconds();
    outcome.failure = failureOf([&] {
      const std::size_t before = startPeakMemory();
      const double begun = secondsBy(isProcessor);
      const auto model = identified(setting);
      outcome.seconds.push_back(secondsBy(isProcessor) - begun);
      const std::size_t peak = peakMemory();
      outcome.peakBytes.push_back(peak > before ? static_cast<double>(peak - before) : 0);
      look(model, outcome);
    });
    if (isInterrupted()) throw std::runtime_error("interrupted; nothing was written");
    outcome.spent += wallSeconds() - wall;
  }

  /// At displacements under probes that it was not identified from.
  void look(vtkPolyData* model, Outcome& outcome) const {
    const convert::ServedModel served = convert::servedModelOf(model);
    const GreensFunctionsInfo& info = served.greens->info();
    const ElasticModel body(served.mesh, info.material, info.conditions, served.smoothPatches,
                            info.domain);
    const convert::ProbedSurface probed =
        convert::probedSurface(body, others_, kPlaceTolerance * served.mesh->diagonal());
    const Eigen::MatrixXd rows = MeasuredResponse(*served.greens, probed.setup, false).rows();
    double wrong = 0, size = 0;
    for (std::size_t i = 0; i < others_.displacements.size(); ++i) {
      const MeasuredDisplacement& truth = others_.displacements[i];
      const Eigen::Vector3d predicted =
          rows.middleRows<3>(3 * static_cast<Eigen::Index>(i)) * others_.probes[truth.probe].force;
      wrong += (predicted - truth.displacement).squaredNorm();
      size += truth.displacement.squaredNorm();
    }
    outcome.error = std::sqrt(wrong / size);
    outcome.vertices = served.mesh->vertexCount();
    outcome.columns = served.greens->columnCount();
    outcome.storedBytes = 72ul * outcome.vertices * outcome.columns;
  }

  AccuracyStudy described() const {
    AccuracyStudy study;
    study.isIdentification = true;
    study.body = std::filesystem::path(options_.input).stem().string();
    study.method = base_.isFinite ? "finite elements" : "boundary elements";
    study.error =
        "displacements under " + std::to_string(kOtherProbes) +
        " probes that were not measured, identified from " + std::to_string(options_.rig.probes) +
        " probes and " + std::to_string(options_.rig.markers) + " markers, " +
        percent(options_.rig.noise) + " noise, " + percent(options_.rig.outliers) + " outliers";
    study.reference =
        "known truth, " + std::filesystem::path(options_.rig.model).filename().string();
    study.clock = options_.clock;
    study.baseLevel = base_.level;
    return study;
  }

  static TrialResult resultOf(const IdentificationTrial& trial, const Outcome& outcome) {
    TrialResult result;
    result.trial.knob = trial.knob;
    result.trial.value = trial.value;
    result.trial.series = trial.series;
    result.trial.setting.level = trial.setting.level;
    result.trial.isPrecompute = true;
    result.failure = outcome.failure;
    result.knobError = result.error = std::nan("");
    if (!outcome.failure.empty()) return result;
    result.vertices = outcome.vertices;
    result.columns = outcome.columns;
    result.runs = static_cast<int>(outcome.seconds.size());
    result.error = outcome.error;
    result.precompute = quartilesOf(outcome.seconds);
    result.query = {result.knobError, result.knobError, result.knobError};
    result.peakBytes = quartilesOf(outcome.peakBytes);
    result.storedBytes = outcome.storedBytes;
    return result;
  }

  AccuracyOptions options_;
  std::vector<int> levels_;
  std::map<int, vtkSmartPointer<vtkPolyData>> surfaces_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;  ///< null where a surface is to be filled
  vtkSmartPointer<vtkPolyData> table_;
  Measurements others_;
  IdentificationSetting base_;
};

}  // namespace

AccuracyStudy studyIdentification(const AccuracyOptions& options) {
  requireSensible(options);
  return IdentificationRun(options).study();
}

}  // namespace palpate::app
