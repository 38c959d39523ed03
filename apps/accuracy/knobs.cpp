// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/knobs.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <stdexcept>

#include "accuracy/tetrahedra.h"
#include "model/elasticity.h"
#include "terminal.h"

namespace palpate::app {
namespace {

const char* const kPrecisions[] = {"double", "mixed", "float"};
const char* const kRows[] = {"contact", "visible", "all"};

/// Adds the trials of one knob.
class Knobs {
 public:
  Knobs(const Setting& base, const std::vector<int>& levels, const BodyLevels& body)
      : base_(base), levels_(levels), body_(body) {}

  void add(const std::string& knob) {
    static const std::map<std::string, void (Knobs::*)()> ways{
        {"level", &Knobs::addLevels},
        {"method", &Knobs::addMethods},
        {"element", &Knobs::addElements},
        {"tolerance", &Knobs::addTolerances},
        {"solver", &Knobs::addSolvers},
        {"storage", &Knobs::addStorages},
        {"columns", &Knobs::addColumns},
        {"rows", &Knobs::addRows},
        {"mask", &Knobs::addMasks},
        {"contact", &Knobs::addContacts},
        {"collocation", &Knobs::addCollocations},
        {"edges", &Knobs::addEdges},
        {"support", &Knobs::addSupports},
        {"reciprocity", &Knobs::addReciprocities},
        {"combined", &Knobs::addCombined}};
    knob_ = knob;
    (this->*ways.at(knob))();
  }

  std::vector<Trial> take() { return std::move(trials_); }

 private:
  void add(const std::string& value, const Setting& setting, bool isPrecompute,
           std::optional<Setting> best = {}, const std::string& series = {}) {
    trials_.push_back({knob_, value, series.empty() ? knob_ : series, setting, isPrecompute, best});
  }

  /// One trial a level of what `change` makes of the base.
  template <class Change>
  void addOnLevels(const std::string& value, const Change& change, bool hasBest) {
    for (int level : levels_) {
      Setting setting = base_;
      setting.level = level;
      const std::optional<Setting> best = hasBest ? std::optional(setting) : std::nullopt;
      change(setting);
      add(value, setting, true, best, knob_ + ": " + value);
    }
  }

  void addLevels() {
    for (int level : levels_) {
      Setting setting = base_;
      setting.level = level;
      add(std::to_string(level), setting, true, {}, "level, all else as by default");
    }
  }

  void addElements() {
    if (!canBeLinear())
      throw std::invalid_argument(
          "linear tetrahedra lock from a Poisson's ratio of 0.45 on: there is nothing to vary by "
          "the knob element");
    addOnLevels(
        "linear", [](Setting& setting) { setting.method = Method::LinearTetrahedra; }, false);
  }

  bool canBeLinear() const { return !body_.isNearlyIncompressible(); }

  void addMethods() {
    addOnLevels(
        "quadratic tetrahedra",
        [](Setting& setting) { setting.method = Method::QuadraticTetrahedra; }, false);
    if (canBeLinear())  // they lock beyond
      addOnLevels(
          "linear tetrahedra", [](Setting& setting) { setting.method = Method::LinearTetrahedra; },
          false);
  }

  /// Powers of ten down to the last, which is the best.
  void addPowersOfTen(double Setting::*member, int last, bool isPrecompute) {
    Setting best = base_;
    best.*member = std::pow(10.0, last);
    for (int exponent = -1; exponent >= last; --exponent) {
      Setting setting = base_;
      setting.*member = std::pow(10.0, exponent);
      add(number(setting.*member), setting, isPrecompute, best);
    }
  }

  void addTolerances() { addPowersOfTen(&Setting::tolerance, -8, true); }

  void addSolvers() {
    add("double", base_, true, base_, "level, all else as by default");
    for (Precision precision : {Precision::Mixed, Precision::Float})
      addOnLevels(
          kPrecisions[static_cast<int>(precision)],
          [&](Setting& setting) { setting.precision = precision; }, true);
    Setting iterative = base_;  // on larger levels it takes too long for queries of many columns
    iterative.solver = LinearSolver::Iterative;
    add("iterative", iterative, true, base_, "solver: iterative");
  }

  void addStorages() {
    for (bool isFloat : {false, true}) {
      Setting setting = base_;
      setting.floatStorage = isFloat;
      add(isFloat ? "float" : "double", setting, false, base_);
    }
  }

  void addColumns() {
    Setting best = base_;
    best.allColumns = true;
    add("needed", base_, true, best);
    add("all free", best, true, best);
  }

  void addRows() {
    for (Rows rows : {Rows::Contact, Rows::Visible, Rows::All}) {
      Setting setting = base_;
      setting.rows = rows;
      add(kRows[static_cast<int>(rows)], setting, false);
    }
  }

  /// In edges of the base's level; half an edge is a single vertex there.
  void addMasks() {
    const double edge = body_.mesh(base_.level).meanEdgeLength();
    for (double edges : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
      Setting setting = base_;
      setting.radius = edges * edge;
      add(number(edges) + (edges < 1 ? " edges (one vertex)" : " edges"), setting, false);
    }
  }

  void addContacts() { addPowersOfTen(&Setting::contactTolerance, -12, false); }

  void addCollocations() {
    addOnLevels(
        "vertex", [](Setting& setting) { setting.collocation = Collocation::Vertex; }, false);
  }

  void addEdges() {
    const std::size_t before = trials_.size();
    for (int level : levels_) {
      if (!body_.hasSharpEdges(level)) continue;
      Setting setting = base_;
      setting.level = level;
      add("patches", setting, true, {}, "level, all else as by default");
      setting.jumps = TractionJumps::Nowhere;
      add("one traction a vertex", setting, true, {}, "edges: one traction a vertex");
    }
    if (trials_.size() == before)
      throw std::invalid_argument(
          "the surface has no sharp edge on any of the levels: there is nothing to vary by the "
          "knob edges");
  }

  void addSupports() {
    addOnLevels(
        "patches of its own", [](Setting& setting) { setting.jumps = TractionJumps::Support; },
        false);
  }

  void addReciprocities() {
    const bool other = !base_.reciprocal;
    addOnLevels(
        other ? "symmetrised" : "raw", [&](Setting& setting) { setting.reciprocal = other; },
        false);
  }

  void addCombined() {
    addOnLevels(
        "vertex, float",
        [](Setting& setting) {
          setting.collocation = Collocation::Vertex;
          setting.precision = Precision::Float;
        },
        false);
  }

  Setting base_;
  std::vector<int> levels_;
  const BodyLevels& body_;
  std::string knob_;
  std::vector<Trial> trials_;
};

}  // namespace

std::vector<std::string> knobsOf(QueryKind query, Method method, bool isPointSource) {
  std::vector<std::string> knobs{"level"};
  const auto add = [&](std::initializer_list<const char*> more) {
    knobs.insert(knobs.end(), more.begin(), more.end());
  };
  if (method == Method::BoundaryElements)
    add({"tolerance", "solver", "collocation", "combined", "reciprocity", "edges", "support"});
  if (method == Method::QuadraticTetrahedra) add({"element", "reciprocity"});
  if (method == Method::HalfSpace) add({"reciprocity"});
  if (method != Method::HalfSpace) add({"storage"});
  if (!isPointSource && method != Method::HalfSpace) add({"columns"});
  if (method == Method::BoundaryElements && !isPointSource && canUseTetrahedra()) add({"method"});
  if (query == QueryKind::Compliance) add({"rows", "mask"});
  if (query == QueryKind::Force) add({"contact"});
  return knobs;
}

void requireKnown(const std::vector<std::string>& chosen, const std::vector<std::string>& known,
                  const std::string& whose) {
  std::string list;
  for (const std::string& knob : known) list += (list.empty() ? "" : ", ") + knob;
  for (const std::string& knob : chosen)
    if (std::find(known.begin(), known.end(), knob) == known.end())
      throw std::invalid_argument("there is no knob '" + knob + "' of " + whose +
                                  ": choose some of " + list);
}

std::vector<Trial> trialsOf(const std::vector<std::string>& knobs, const Setting& base,
                            const std::vector<int>& levels, const BodyLevels& body) {
  Knobs all(base, levels, body);
  for (const std::string& knob : knobs) all.add(knob);
  return all.take();
}

}  // namespace palpate::app
