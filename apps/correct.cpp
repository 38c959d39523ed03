// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkComplianceCorrection.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "commands.h"
#include "finite_check.h"
#include "measurement_options.h"
#include "report/identification_page.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output;
  MeasurementOptions measurements;
  int modes = 0, folds = 5;
  double smoothing = 0;
  bool keepsOutliers = false;
  ReportOption report;
};

void addOptions(CLI::App& command, Options& o) {
  command.add_option("input", o.input, "The prior: a model of any method")->required();
  requireWritable(command.add_option("output", o.output, "The model corrected, .vtp")->required(),
                  "models", ".vtp");
  o.measurements.addTo(command);
  command
      .add_option("--modes", o.modes,
                  "Correct in so many leading modes of the prior's compliance; 0 for all")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  command
      .add_option("--smoothing", o.smoothing,
                  "Noise over what is corrected, variances; by default as probes left out tell")
      ->check(isFinite())
      ->check(CLI::PositiveNumber);
  command.add_option("--folds", o.folds, "Of the cross-validation by probes")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command.add_flag("--keep-outliers", o.keepsOutliers,
                   "Believe displacements that contradict the rest, too");
  o.report.addTo(command, "what was found and how it fits");
  command.footer(
      "The table is that of `palpate identify`. The material should be identified first, and what\n"
      "it does not explain corrected then:\n"
      "  palpate identify part.vtp prior.vtp --measurements rig.csv\n"
      "  palpate correct prior.vtp part_model.vtp --measurements rig.csv");
}

void print(vtkPolyData* model, const MeasurementOptions& measurements) {
  for (const std::string& source : fieldStrings(model, "GreensFunctionSource"))
    printRow("made by", source);
  printRow("factor on the prior's compliance",
           number(model->GetFieldData()->GetArray("IdentifiedParameters")->GetComponent(0, 0)));
  printRow("residuals", number(fieldNumber(model, "MeasurementNoise", -1), 3) + " m (rms)");
  printRow("outliers", measurements.outliersOf(model));
  printRow("smoothing", number(fieldNumber(model, "CorrectionSmoothing", -1), 3));
  const double error = fieldNumber(model, "HoldOutError", -1),
               prior = fieldNumber(model, "PriorHoldOutError", -1);
  if (error >= 0)
    printRow("error at probes left out", percent(error) + ", by the prior " + percent(prior) +
                                             ", noise and all; fitted ones " +
                                             percent(fieldNumber(model, "FitError", -1)));
}

}  // namespace

void addCorrect(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "correct", "Correct a model's Green's functions by measured displacements");
  addOptions(*command, *options);
  command->callback([options] {
    vtkNew<vtkComplianceCorrection> filter;
    filter->SetInputData(readSurface(options->input));
    options->measurements.applyTo(filter.Get(), 1);
    filter->SetNumberOfModes(options->modes);
    filter->SetSmoothing(options->smoothing);
    filter->SetNumberOfFolds(options->folds);
    filter->SetLeaveOutOutliers(!options->keepsOutliers);
    const auto model = run(filter);
    writeSurface(model, options->output);
    options->report.write(
        [&](const RunDescription& run) { return identificationPage(model, nullptr, run); });
    print(model, options->measurements);
    printWarnings(model);
  });
}

}  // namespace palpate::app
