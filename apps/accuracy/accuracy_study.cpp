// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/accuracy_study.h"

#include <read_files.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkReferenceBoundaryConditions.h>
#include <vtkSolidBoundary.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "accuracy/identification_study.h"
#include "accuracy/knobs.h"
#include "accuracy/pareto_front.h"
#include "accuracy/points.h"
#include "accuracy/reference.h"
#include "accuracy/sweep.h"
#include "file_kinds.h"
#include "model/elasticity.h"
#include "progress_bar.h"
#include "sentence.h"
#include "terminal.h"

namespace palpate::app {
namespace {

constexpr double kSourceDistance = 0.75;  ///< diagonals of the body from its middle

/// The body on the surface of a file, or of its tetrahedra.
BodyLevels bodyOf(const AccuracyOptions& options) {
  const int finest = std::max(*std::max_element(options.levels.begin(), options.levels.end()),
                              options.referenceLevel);
  vtkNew<vtkReferenceBoundaryConditions> conditions;
  options.support.applyTo(conditions);
  if (!isVolumeFile(options.input)) {
    conditions->SetInputData(readSurface(options.input));
    return BodyLevels(run(conditions), nullptr, finest, options);
  }
  if (options.method != "fem")
    throw std::invalid_argument(options.input + " is a volume mesh: add --method fem");
  const auto volume = readVolume(options.input);
  vtkNew<vtkSolidBoundary> boundary;
  boundary->SetInputData(volume);
  conditions->SetInputData(run(boundary));
  return BodyLevels(run(conditions), volume, finest, options);
}

/// Whether a reference is a file of compliances.
bool isFile(const std::string& reference) {
  return reference != "finest" && reference != "kelvin" && reference != "boussinesq";
}

QueryKind kindOf(const std::string& query) {
  return query == "greens"  ? QueryKind::Greens
         : query == "force" ? QueryKind::Force
                            : QueryKind::Compliance;
}

/// The knobs that are varied, checked.
std::vector<std::string> chosenKnobs(const AccuracyOptions& options, const BodyLevels& body,
                                     bool hasSharpEdges) {
  std::vector<std::string> known =
      knobsOf(kindOf(options.query), methodNamed(options.method), options.reference == "kelvin");
  const auto drop = [&](const char* knob) {
    known.erase(std::remove(known.begin(), known.end(), knob), known.end());
  };
  if (isFile(options.reference)) drop("mask");
  requireKnown(options.knobs, known,
               "the query " + options.query + " and the method " + options.method +
                   " against the reference " + options.reference);
  if (!options.knobs.empty()) return options.knobs;
  if (!hasSharpEdges) drop("edges");
  if (body.isNearlyIncompressible()) drop("element");
  return known;
}

void requireSensible(const AccuracyOptions& options) {
  if (options.reference == "kelvin" && options.query != "greens")
    throw std::invalid_argument(
        "a point source's field is known on the whole surface: the reference kelvin is one of "
        "`--query greens`");
  if (options.reference == "kelvin" && options.method != "bem")
    throw std::invalid_argument("the reference kelvin is one of --method bem, not of " +
                                options.method);
  if (options.reference == "boussinesq" &&
      (options.method != "halfspace" || options.query != "compliance"))
    throw std::invalid_argument(
        "the reference boussinesq is one of --method halfspace and --query compliance");
  if (options.method != "shell" && (options.thickness > 0 || options.hinged))
    throw std::invalid_argument("--thickness and --hinged make no sense with --method " +
                                options.method + ": leave them out");
  if (options.method == "halfspace" && options.support.fixes())
    throw std::invalid_argument("a half-space needs no support: leave out what fixes it");
  const int last = *std::max_element(options.levels.begin(), options.levels.end());
  if (options.referenceLevel > 0 && options.reference != "finest")
    throw std::invalid_argument("--reference-level is one of the reference finest, not of " +
                                options.reference);
  if (options.referenceLevel > 0 && options.referenceLevel < last)
    throw std::invalid_argument("--reference-level " + std::to_string(options.referenceLevel) +
                                " is coarser than the last of --levels, " + std::to_string(last));
  if (!isFile(options.reference)) return;
  if (options.query != "compliance")
    throw std::invalid_argument("the file " + options.reference +
                                " gives compliances: it is a reference of `--query compliance`");
  if (!options.points.empty())
    throw std::invalid_argument("the points are those of the file " + options.reference +
                                ": leave --at out");
  if (options.radius == 0)
    throw std::invalid_argument("say by --radius under which mask the compliances of " +
                                options.reference + " are");
}

/// An error as it counts for the front: to three digits, as differences beyond are of no use, and
/// the reference's uncertainty where it cannot tell the answer from the truth.
double countedError(const TrialResult& result) {
  return std::stod(number(std::max(result.error, result.uncertainty), 3));
}

/// Everything on the way from options to results.
class AccuracyRun {
 public:
  explicit AccuracyRun(const AccuracyOptions& options)
      : options_(options),
        levels_(options.levels),
        body_(bodyOf(options)),
        progress_([](double fraction, const char* stage) {
          drawProgress(fraction, stage);
          return !isInterrupted();
        }) {
    std::sort(levels_.begin(), levels_.end());
    levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
    radius_ = options_.radius > 0 ? options_.radius : body_.mesh(1).meanEdgeLength();
    readPoints();
    setQuery();
    setBase();
  }

  AccuracyStudy run() {
    bool hasSharpEdges = false;
    for (int level : levels_) hasSharpEdges = hasSharpEdges || body_.hasSharpEdges(level);
    std::vector<Trial> trials =
        trialsOf(chosenKnobs(options_, body_, hasSharpEdges), base_, levels_, body_);
    if (options_.reference == "boussinesq") keepWholeMasks(trials);
    const Reference reference = this->reference(trials);
    std::vector<Setting> settings;
    for (const Trial& trial : trials) {
      settings.push_back(trial.setting);
      if (trial.best) settings.push_back(*trial.best);
    }
    const Sweep sweep(
        body_, *query_, settings,
        {options_.repeats, options_.threads, options_.budget, options_.clock == "cpu"},
        progress_.part(kReferenceShare, 1));
    endProgressBar();
    AccuracyStudy study = described(reference);
    for (const Trial& trial : trials) study.results.push_back(resultOf(trial, sweep, reference));
    for (bool isPrecompute : {true, false}) markFront(study.results, isPrecompute);
    return study;
  }

 private:
  static constexpr double kReferenceShare = 0.2;  ///< of the time, for the progress display

  void readPoints() {
    std::vector<double> places = options_.points;
    if (isFile(options_.reference)) {
      table_ = readCompliances(options_.reference);
      places = table_.points;
    }
    for (const SurfacePoint& point :
         places.empty() ? spreadPoints(body_, radius_) : pointsAt(body_, places))
      points_.push_back(body_.ancestors(point));
  }

  void setQuery() {
    ballRadius_ = options_.ballRadius > 0 ? options_.ballRadius : radius_;
    depth_ = options_.depth > 0 ? options_.depth : 0.1 * ballRadius_;
    const SurfaceMesh& finest = body_.mesh(body_.count());
    const Eigen::Vector3d middle =
        0.5 * (finest.points().rowwise().minCoeff() + finest.points().rowwise().maxCoeff());
    const Eigen::Vector3d outwards =
        (placeOf(finest, points_.front().back()) - middle).normalized();
    source_ = middle + kSourceDistance * finest.diagonal() * outwards;
    switch (kindOf(options_.query)) {
      case QueryKind::Compliance:
        query_ = complianceQuery(body_, points_);
        break;
      case QueryKind::Greens:
        query_ = isKelvin() ? pointSourceQuery(body_, source_) : surfaceQuery(body_, points_);
        break;
      case QueryKind::Force:
        query_ = forceQuery(body_, points_, ballRadius_, depth_);
    }
  }

  void setBase() {
    const std::size_t last = levels_.size() - 1;
    base_.level = options_.baseLevel > 0 ? options_.baseLevel : levels_[last > 0 ? last - 1 : 0];
    if (std::find(levels_.begin(), levels_.end(), base_.level) == levels_.end())
      throw std::invalid_argument("--base-level is one of --levels, which have no level " +
                                  std::to_string(base_.level));
    base_.radius = radius_;
    base_.method = methodNamed(options_.method);
    base_.reciprocal = !isKelvin();
  }

  bool isKelvin() const { return options_.reference == "kelvin"; }

  /// The closed form is that of masks that no rim cuts off.
  void keepWholeMasks(std::vector<Trial>& trials) const {
    const double reach = widestWholeMask(body_, points_);
    if (radius_ > reach)
      refuse("a point is ", reach, " from the rim, which cuts off its mask of ", radius_,
             ": give a smaller --radius, or --reference finest");
    trials.erase(std::remove_if(trials.begin(), trials.end(),
                                [&](const Trial& trial) { return trial.setting.radius > reach; }),
                 trials.end());
  }

  Reference reference(const std::vector<Trial>& trials) const {
    if (isKelvin())
      return Reference::exact("exact field of a point force at " + vectorText(source_.data()) +
                              " outside the body (Kelvin)");
    if (isFile(options_.reference))
      return Reference::given("compliances of " + options_.reference, table_.values);
    std::set<double> radii{base_.radius};
    for (const Trial& trial : trials) radii.insert(trial.setting.radius);
    if (options_.reference == "boussinesq")
      return Reference::boussinesq(body_.material(), body_.mesh(1).triangleNormals().col(0),
                                   {radii.begin(), radii.end()}, static_cast<int>(points_.size()));
    return Reference::finest(body_, *query_, base_, {radii.begin(), radii.end()}, options_.threads,
                             progress_.part(0, kReferenceShare));
  }

  AccuracyStudy described(const Reference& reference) const {
    AccuracyStudy study;
    study.body = std::filesystem::path(options_.input).stem().string();
    study.method = nameOf(base_.method);
    study.reference = reference.name();
    study.error = query_->description();
    study.query = kindOf(options_.query);
    study.clock = options_.clock;
    study.baseLevel = base_.level;
    if (isKelvin()) return study;
    for (const LevelledPoint& point : points_) {
      const Eigen::Vector3d place = placeOf(body_.mesh(body_.count()), point.back());
      study.points.push_back({place.x(), place.y(), place.z()});
    }
    study.radius = radius_;
    study.ballRadius = ballRadius_;
    study.depth = depth_;
    study.uncertainty = reference.uncertainty(base_);
    return study;
  }

  TrialResult resultOf(const Trial& trial, const Sweep& sweep, const Reference& reference) const {
    const Sample& sample = sweep.of(trial.setting);
    TrialResult result;
    result.trial = trial;
    result.vertices = body_.mesh(trial.setting.level).vertexCount();
    result.failure = sample.failure;
    result.knobError = result.error = std::nan("");
    if (!sample.failure.empty()) return result;
    result.columns = sample.columns;
    result.runs = static_cast<int>(sample.querySeconds.size());
    result.error = reference.errorOf(sample.answer, trial.setting);
    result.uncertainty = reference.uncertainty(trial.setting);
    if (trial.best && sweep.of(*trial.best).failure.empty())
      result.knobError =
          relativeError(sample.answer, sample.answer.values, sweep.of(*trial.best).answer.values);
    result.precompute = quartilesOf(sample.precomputeSeconds);
    result.query = quartilesOf(sample.querySeconds);
    const auto peak = static_cast<double>(sample.peakBytes);
    result.peakBytes = {peak, peak, peak};
    result.storedBytes = sample.storedBytes;
    return result;
  }

  AccuracyOptions options_;
  std::vector<int> levels_;
  BodyLevels body_;
  Progress progress_;
  ComplianceTable table_;
  std::vector<LevelledPoint> points_;
  double radius_ = 0, ballRadius_ = 0, depth_ = 0;
  Eigen::Vector3d source_ = Eigen::Vector3d::Zero();
  std::unique_ptr<const Query> query_;
  Setting base_;
};

}  // namespace

void markFront(std::vector<TrialResult>& results, bool isPrecompute) {
  std::vector<double> times, errors;
  for (const TrialResult& result : results) {
    const bool isOfStage = result.trial.isPrecompute == isPrecompute && result.failure.empty();
    times.push_back(isOfStage ? result.time().median : std::nan(""));
    errors.push_back(isOfStage ? countedError(result) : std::nan(""));
  }
  const std::vector<bool> front = paretoFront(times, errors);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (front[i]) results[i].isOnFront = true;
}

AccuracyStudy studyAccuracy(const AccuracyOptions& given) {
  if (given.query == "identification") return studyIdentification(given);
  if (!given.rig.model.empty())
    throw std::invalid_argument("--rig is one of --query identification, not of " + given.query);
  AccuracyOptions options = given;
  if (options.reference.empty()) {
    const bool isKnown = options.method == "halfspace" && options.query == "compliance";
    options.reference = isKnown ? "boussinesq" : "finest";
  }
  requireSensible(options);
  try {
    return AccuracyRun(options).run();
  } catch (const Aborted&) {
    throw std::runtime_error("interrupted; nothing was written");
  }
}

}  // namespace palpate::app
