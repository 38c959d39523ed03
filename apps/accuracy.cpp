// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>

#include "accuracy/accuracy_study.h"
#include "commands.h"
#include "subdivision_option.h"
#include "terminal.h"
#include "whole_file.h"

namespace palpate::app {
namespace {

struct Options {
  AccuracyOptions study;
  std::string report, csv, svg, image;
};

void addFiles(CLI::App& command, Options& o) {
  requireWritable(
      command.add_option("--report", o.report,
                         "The page, .html; table and plot go beside it as .csv and .svg"),
      "reports", ".html");
  requireWritable(command.add_option("--csv", o.csv, "The table alone"), "tables", ".csv");
  requireWritable(command.add_option("--svg", o.svg, "The plot alone"), "plots", ".svg");
  requireWritable(
      command.add_option("--image", o.image, "The plot as a PNG file; needs no display"),
      "pictures", ".png");
}

void addQuestion(CLI::App& command, AccuracyOptions& o) {
  command
      .add_option("input", o.input,
                  "A surface with support and material; a model counts as its surface. With "
                  "--method fem also a volume mesh (.vtu), whose cells may be of several "
                  "materials: each is cut into eight from level to level, and taken as it is for "
                  "identification")
      ->required();
  command
      .add_option("--method", o.method,
                  "What the Green's functions are computed by: bem, fem, shell or halfspace; "
                  "imported ones have no discretisation to vary")
      ->check(CLI::IsMember({"bem", "fem", "shell", "halfspace"}))
      ->capture_default_str();
  command
      .add_option("--thickness", o.thickness,
                  "Of --method shell, m; by default the surface's array Thickness")
      ->check(CLI::PositiveNumber);
  command.add_flag("--hinged", o.hinged, "Fixed vertices of a shell may turn");
  command
      .add_option("--query", o.query,
                  "compliance under a mask at points, greens (displacement of the whole surface), "
                  "force (on a ball that is pressed in), or identification, from what a rig would "
                  "measure of a known model")
      ->check(CLI::IsMember({"compliance", "greens", "force", "identification"}))
      ->capture_default_str();
  command
      .add_option("--at", o.points,
                  "A point of the surface, three numbers; may be repeated. By default four that "
                  "are spread over it")
      ->type_size(3)
      ->take_all();
  command
      .add_option("--radius", o.radius,
                  "Radius of the mask; by default a mean edge of the surface as it is")
      ->check(CLI::PositiveNumber);
  command.add_option("--ball-radius", o.ballRadius, "Of --query force; by default the mask's")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--depth", o.depth,
                  "How deep the ball is pressed; by default a tenth of its radius")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--reference", o.reference,
                  "finest (Richardson extrapolation), kelvin (a point source's exact field, of "
                  "--query greens), boussinesq (closed form, of --method halfspace), or a CSV "
                  "file: x,y,z and nine compliances a line, cxx,cxy,...")
      ->default_str("finest, of a half-space's compliances boussinesq");
}

void addRig(CLI::App& command, RigOptions& o) {
  const char* const group = "Of --query identification";
  CLI::Option* rig =
      command
          .add_option("--rig", o.model,
                      "A model of the body as it is, of another mesh or method than the surface "
                      "that is identified: it is measured as by `palpate measure`")
          ->group(group);
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->capture_default_str()->needs(rig)->group(group);
  };
  add("--probes", o.probes, "How many press")->check(CLI::Range(1, 10000));
  add("--markers", o.markers, "How many are seen under each")->check(CLI::Range(1, 100000));
  add("--noise", o.noise, "Standard deviation, over the largest displacement")
      ->check(CLI::Range(0.0, 1.0));
  add("--outliers", o.outliers, "Share of displacements that are wrong")
      ->check(CLI::Range(0.0, 1.0));
  add("--seed", o.seed, "Of all that is random")->check(CLI::Range(0, 1000000));
}

void addSweep(CLI::App& command, AccuracyOptions& o) {
  command.add_option("--levels", o.levels, "Levels of the surface, 1 as it is")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  addSubdivision(command, o.subdivision)
      ->default_str("loop of bodies, curved of shells, flat of half-spaces");
  command
      .add_option("--base-level", o.baseLevel,
                  "Level on which the other knobs are varied; by default the last but one")
      ->check(CLI::Range(1, 9));
  command
      .add_option("--reference-level", o.referenceLevel,
                  "Finest level that `finest` extrapolates from; by default the last of --levels")
      ->check(CLI::Range(1, 9));
  command.add_option(
      "--knobs", o.knobs,
      "What is varied: level, tolerance, solver, collocation, combined, "
      "reciprocity, edges, support, storage, columns, method, element, rows, "
      "mask, contact; of identification level, loss, interpolation, elements, field, "
      "correction; by default all that query and method have");
  command.add_option("--repeats", o.repeats, "Runs of every setting, in turn")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command
      .add_option("--budget", o.budget,
                  "Seconds after which a setting is not repeated beyond twice")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--clock", o.clock, "wall, or the processor time of all threads: cpu")
      ->check(CLI::IsMember({"wall", "cpu"}))
      ->capture_default_str();
  command.add_option("--threads", o.threads, "0 for all cores")->check(CLI::Range(0, 1024));
}

void printResult(const TrialResult& result) {
  const std::string label =
      "  " + result.trial.value + ", level " + std::to_string(result.trial.setting.level);
  if (!result.failure.empty()) {
    printRow(label, result.failure);
    return;
  }
  char text[160];
  std::snprintf(text, sizeof text, "%9.3g %%%s %9.3g s (%.3g to %.3g, %d runs) %8.3g MB%s",
                100 * result.error, result.isBelowCertainty() ? "?" : " ", result.time().median,
                result.time().lower, result.time().upper, result.runs,
                (result.trial.isPrecompute ? result.peakBytes.median
                                           : static_cast<double>(result.storedBytes)) /
                    1e6,
                result.isOnFront ? "  front" : "");
  printRow(label, text);
}

void printStudy(const AccuracyStudy& study) {
  printRow("method", study.method);
  printRow("error of", study.error);
  printRow("against", study.reference);
  if (study.uncertainty > 0)
    printRow("uncertainty of that",
             number(100 * study.uncertainty, 3) + " % (? marks errors below)");
  for (const auto& point : study.points) printRow("point", vectorText(point.data()));
  if (study.query == QueryKind::Force) {
    printRow("ball's radius", number(study.ballRadius));
    printRow("ball's depth", number(study.depth));
  } else if (!study.points.empty()) {
    printRow("mask radius", number(study.radius));
  }
  std::string knob;
  for (const TrialResult& result : study.results) {
    if (result.trial.knob != knob)
      printRow(result.trial.knob,
               std::string("error, seconds to ") + (study.isIdentification      ? "identify, peak"
                                                    : result.trial.isPrecompute ? "precompute, peak"
                                                                                : "query, stored"));
    knob = result.trial.knob;
    printResult(result);
  }
}

/// A file by its path, and what makes its text.
using File = std::pair<std::string, std::function<std::string(const AccuracyStudy&)>>;

std::vector<File> filesOf(const Options& o) {
  const auto svg = [](const AccuracyStudy& study) { return accuracySvg(study, true); };
  std::vector<File> files;
  if (!o.csv.empty()) files.emplace_back(o.csv, accuracyCsv);
  if (!o.svg.empty()) files.emplace_back(o.svg, svg);
  if (o.report.empty()) return files;
  const auto beside = [&o](const char* extension) {
    return std::filesystem::path(o.report).replace_extension(extension).string();
  };
  files.emplace_back(beside(".csv"), accuracyCsv);
  files.emplace_back(beside(".svg"), svg);
  files.emplace_back(o.report, accuracyPage);
  return files;
}

/// Before hours of work: files can be written, and none that is read is overwritten.
void requireSensibleFiles(const Options& o) {
  std::vector<std::string> written;
  if (!o.image.empty()) written.push_back(o.image);
  for (const File& file : filesOf(o)) written.push_back(file.first);
  for (const std::string& path : written) {
    const std::string reason = whyUnwritable(path);
    if (!reason.empty()) throw std::invalid_argument(reason);
    for (const std::string& read : {o.study.input, o.study.reference, o.study.rig.model}) {
      std::error_code ignored;
      if (std::filesystem::equivalent(path, read, ignored))
        throw std::invalid_argument("the results would overwrite " + path +
                                    ", which they are made from: give them another name");
    }
  }
}

void writeStudy(const AccuracyStudy& study, const Options& o) {
  std::vector<std::string> texts;  // all made before the first is written
  const std::vector<File> files = filesOf(o);
  for (const File& file : files) texts.push_back(file.second(study));
  for (std::size_t i = 0; i < files.size(); ++i)
    writeWholeFile(files[i].first, [&](std::ostream& file) { file << texts[i]; });
  if (!o.image.empty()) drawAccuracy(study, o.image);  // last, as it may lack a display
}

}  // namespace

void addAccuracy(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "accuracy", "What accuracy costs: error against time of every knob, for a query on a body");
  addQuestion(*command, options->study);
  addSweep(*command, options->study);
  addRig(*command, options->study.rig);
  options->study.support.addTo(*command);
  addFiles(*command, *options);
  command->footer(
      "Settings are run in turn, over and over, so that a machine that slows down biases none.\n"
      "  palpate accuracy data/kidney.vtp --levels 1 2 3 --report kidney_accuracy.html\n"
      "  palpate accuracy part.vtp --query force --depth 0.001 --subdivision flat\n"
      "  palpate accuracy bonnet.vtp --method shell --thickness 0.001\n"
      "  palpate accuracy patch.vtp --method halfspace --reference boussinesq\n"
      "  palpate accuracy layers.vtu --method fem --levels 1 2 3\n"
      "  palpate accuracy part.vtp --query identification --rig part_as_it_is.vtp");
  command->callback([options] {
    requireSensibleFiles(*options);
    const AccuracyStudy study = studyAccuracy(options->study);
    printStudy(study);
    writeStudy(study, *options);
  });
}

}  // namespace palpate::app
