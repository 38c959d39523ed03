// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <cmath>
#include <map>

#include "accuracy/accuracy_study.h"
#include "report/html.h"
#include "terminal.h"

namespace palpate::app {
namespace {

std::string secondsText(const Quartiles& time) {
  return number(time.median, 3) + " (" + number(time.lower, 3) + " to " + number(time.upper, 3) +
         ")";
}

std::string megabytes(double bytes) {
  return number(bytes / 1e6, 3);
}

std::string megabytes(const Quartiles& bytes) {
  const std::string spread = bytes.lower < bytes.upper ? " (" + megabytes(bytes.lower) + " to " +
                                                             megabytes(bytes.upper) + ")"
                                                       : "";
  return megabytes(bytes.median) + spread;
}

/// What a knob is, above its table.
std::string meaningOf(const std::string& knob) {
  static const std::map<std::string, std::string> meanings{
      {"level", "Refinements of the surface; all other knobs at their defaults."},
      {"tolerance", "Relative tolerance of each integral over a triangle."},
      {"solver",
       "Factored in double, in float and refined in double (mixed), or in float; or iterated in "
       "double."},
      {"collocation", "The integral equation at the vertices alone, as in the paper."},
      {"method", "Finite elements in tetrahedra that fill the surface, quadratic or linear."},
      {"element", "Linear tetrahedra in place of quadratic ones."},
      {"combined", "Vertex collocation and float arithmetic together."},
      {"reciprocity", "The compliance symmetrised as it is served, or raw."},
      {"edges",
       "At sharp edges one traction a vertex and smooth patch, or one a vertex as in the paper."},
      {"support",
       "The support's triangles as smooth patches of their own, at whose rim its traction ends "
       "sharply; else it fades over the next triangles."},
      {"storage", "Green's functions computed in double and stored as double or float."},
      {"columns", "Green's functions of the nodes that the query needs, or of all free nodes."},
      {"rows", "Rows of which the deformation is evaluated."},
      {"mask",
       "The mask's radius in mean edges of this level, against the same radius in the reference."},
      {"contact", "Relative tolerance of the contact solver."},
      {"loss", "How residuals count while outliers are looked for, of the material of one body."},
      {"interpolation",
       "Relative tolerance of responses between the materials for which they are computed."},
      {"elements", "The material by the other method, on every level."},
      {"field",
       "Stiffness that varies inside, in so many modes, by finite elements in place of one "
       "material."},
      {"correction",
       "The identified model's Green's functions corrected in so many of its leading modes; "
       "seconds "
       "are of both."}};
  return meanings.at(knob);
}

std::string tableOf(const AccuracyStudy& study, const std::string& knob) {
  std::vector<std::vector<std::string>> rows;
  for (const TrialResult& result : study.results) {
    if (result.trial.knob != knob) continue;
    std::vector<std::string> row{html::escaped(result.trial.value),
                                 std::to_string(result.trial.setting.level),
                                 std::to_string(result.vertices)};
    if (!result.failure.empty()) {
      row.push_back(html::escaped(result.failure));
      rows.push_back(row);
      continue;
    }
    row.push_back(percent(result.error) + (result.isBelowCertainty() ? " ?" : ""));
    if (!study.isIdentification) row.push_back(percent(result.knobError));
    row.push_back(result.isOnFront ? "●" : "");
    row.push_back(secondsText(result.precompute));
    if (!study.isIdentification) row.push_back(secondsText(result.query));
    row.push_back(std::to_string(result.runs));
    row.push_back(std::to_string(result.columns));
    row.push_back(megabytes(result.peakBytes));
    row.push_back(megabytes(static_cast<double>(result.storedBytes)));
    rows.push_back(row);
  }
  if (study.isIdentification)
    return html::table(
        {knob, "level", "vertices", "error", "Pareto front", "seconds to identify (quartiles)",
         "runs", "columns", "peak, MB", "stored, MB"},
        rows);
  return html::table({knob, "level", "vertices", "error", "of it the knob's own", "Pareto front",
                      "seconds to precompute (quartiles)", "seconds a query (quartiles)", "runs",
                      "columns", "peak, MB", "stored, MB"},
                     rows);
}

std::string questionText(const AccuracyStudy& study) {
  std::string text = "<p class=\"lead\">By " + html::escaped(study.method) + ": error of the " +
                     html::escaped(study.error) + ", against the " +
                     html::escaped(study.reference) + ".</p>\n";
  if (study.points.empty() && !(study.uncertainty > 0)) return text;
  text += "<ul>\n";
  if (study.uncertainty > 0)
    text += "<li>That reference is uncertain by " + percent(study.uncertainty) +
            " itself; smaller errors are marked by ? and by hollow marks, and count as that much "
            "for the Pareto front.</li>\n";
  if (study.query != QueryKind::Force)
    text += "<li>Masks are linear, " + number(study.radius) + " m in radius.</li>\n";
  else
    text += "<li>The ball is " + number(study.ballRadius) + " m in radius and pressed in by " +
            number(study.depth) + " m.</li>\n";
  text += "<li>Points:";
  for (const auto& point : study.points) text += " (" + vectorText(point.data()) + ")";
  return text + "</li>\n</ul>\n";
}

}  // namespace

std::string accuracyPage(const AccuracyStudy& study) {
  std::string body = "<h1>" + html::escaped(study.body) + ": what accuracy costs</h1>\n" +
                     questionText(study) + "<figure><div class=\"wide\">" +
                     accuracySvg(study, false) +
                     "</div><figcaption>Error against time. Along the first line the surface is "
                     "refined; numbers are its vertices. Other knobs were varied at level " +
                     std::to_string(study.baseLevel) +
                     ", or at each level. Rings: nothing else is both faster and more "
                     "accurate.</figcaption></figure>\n";
  std::string knob;
  for (const TrialResult& result : study.results) {
    if (result.trial.knob == knob) continue;
    knob = result.trial.knob;
    body += "<h2>" + html::escaped(knob) + "</h2>\n<p>" + meaningOf(knob) + "</p>\n" +
            tableOf(study, knob);
  }
  const std::string memory = study.isIdentification
                                 ? "Memory is what the process took in addition, at its peak."
                                 : "A query is repeated within a run until it takes 10 ms.";
  body += "<h2>How it was measured</h2>\n<p>Medians of the runs with their quartiles, by the " +
          std::string(study.clock == "cpu" ? "processor time of all threads" : "wall clock") +
          ". All settings are run in turn, and again in the next round, so that a machine that "
          "slows down biases none; those that take long are run less often, twice at least. " +
          memory + "</p>\n";
  return html::page(study.body + ": what accuracy costs", body);
}

}  // namespace palpate::app
