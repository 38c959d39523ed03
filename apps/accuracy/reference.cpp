// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/reference.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "accuracy/compute_greens.h"
#include "accuracy/richardson.h"
#include "sentence.h"
#include "terminal.h"

namespace palpate::app {
namespace {

/// A query of several radii: its columns are those of them all.
class AllRadii final : public Query {
 public:
  AllRadii(const Query& query, const std::vector<double>& radii) : query_(query), radii_(radii) {}
  std::vector<int> columns(const Setting& setting) const override {
    std::vector<int> all;
    for (double radius : radii_) {
      Setting wanted = setting;
      wanted.radius = radius;
      const std::vector<int> columns = query_.columns(wanted);
      all.insert(all.end(), columns.begin(), columns.end());
    }
    return all;
  }
  bool usesPatchColumns() const override { return query_.usesPatchColumns(); }
  std::unique_ptr<PreparedQuery> prepare(std::shared_ptr<const GreensFunctions> greens,
                                         const Setting& setting) const override {
    return query_.prepare(std::move(greens), setting);
  }
  std::string description() const override { return query_.description(); }

 private:
  const Query& query_;
  std::vector<double> radii_;
};

std::string nameOf(const RichardsonExtrapolation& found, const BodyLevels& body, Method method,
                   int first) {
  std::string levels;
  for (int level = first; level <= body.count(); ++level)
    levels += (level == first          ? ""
               : level == body.count() ? " and "
                                       : ", ") +
              std::to_string(level);
  return "Richardson extrapolation of levels " + levels + " (" +
         std::to_string(body.mesh(body.count()).vertexCount()) + " vertices) at the " +
         (found.isObserved           ? "observed order " + number(found.order, 3)
          : body.count() - first > 1 ? "order 1, as their differences show none"
                                     : "stated order " + number(found.order, 3)) +
         (method == Method::BoundaryElements
              ? ", double precision, averaged collocation, the support as patches of its own, "
                "integration tolerance 1e-06"
              : ", " + nameOf(method));
}

/// @throws std::runtime_error that names the level, where the method cannot take it.
std::shared_ptr<const GreensFunctions> ofLevel(const BodyLevels& body, const Query& query,
                                               const Setting& setting, int threads,
                                               const ProgressCallback& progress) {
  try {
    return computeGreens(body, query, setting, threads, false, progress).greens;
  } catch (const Aborted&) {
    throw;
  } catch (const std::runtime_error& failure) {
    throw std::runtime_error(sentence("the reference needs level ", setting.level, ", at which ",
                                      failure.what(), ": give --levels that end with a later one"));
  }
}

}  // namespace

Reference Reference::exact(std::string name) {
  Reference reference;
  reference.name_ = std::move(name);
  return reference;
}

Reference Reference::given(std::string name, Eigen::VectorXd values) {
  Reference reference;
  reference.name_ = std::move(name);
  reference.isForAllRadii_ = true;
  reference.ofRadius_[0] = {std::move(values), 0};
  return reference;
}

Reference Reference::boussinesq(const Material& material, const Eigen::Vector3d& normal,
                                const std::vector<double>& radii, int points) {
  Reference reference;
  reference.name_ =
      "half-space's compliance at the centre of a linear mask in closed form (Boussinesq, Cerruti)";
  const double nu = material.poissonRatio();
  for (double radius : radii) {
    const double across = 3 / std::acos(-1.0) * (1 - nu * nu) / (material.youngsModulus() * radius);
    const double along = across * (2 - nu) / (2 * (1 - nu));
    const Eigen::Matrix3d compliance =
        along * Eigen::Matrix3d::Identity() + (across - along) * normal * normal.transpose();
    reference.ofRadius_[radius] = {Eigen::VectorXd(compliance.reshaped().replicate(points, 1)), 0};
  }
  return reference;
}

Reference Reference::finest(const BodyLevels& body, const Query& query, const Setting& base,
                            const std::vector<double>& radii, int threads,
                            const Progress& progress) {
  if (body.count() < 2)
    throw std::invalid_argument(
        "the reference `finest` extrapolates from two levels or more: give --levels up to 2 at "
        "least, or another --reference");
  const AllRadii all(query, radii);
  const int first = std::max(1, body.count() - 2);
  std::map<double, std::vector<Eigen::VectorXd>> answers;
  Answer last;
  for (int level = first; level <= body.count(); ++level) {
    const Progress part = progress.part(level == body.count() ? 0.2 : 0.1 * (level - first),
                                        level == body.count() ? 1 : 0.1 * (level - first + 1));
    Setting setting = base;
    setting.level = level;
    setting.jumps = TractionJumps::Support;  // converges faster where the support ends
    // What symmetrising does to a half-space goes with the edges, all else with their square.
    if (setting.method == Method::HalfSpace) setting.reciprocal = false;
    const auto greens = ofLevel(body, all, setting, threads, part.callback());
    for (double radius : radii) {
      setting.radius = radius;
      const auto prepared = query.prepare(greens, setting);
      prepared->evaluate();
      last = prepared->answer();
      answers[radius].push_back(last.values);
    }
  }
  Reference reference;
  for (const auto& [radius, sequence] : answers) {
    const RichardsonExtrapolation found =
        extrapolate(sequence, [&, &finest = sequence.back()](const Eigen::VectorXd& difference) {
          return relativeError(last, finest + difference, finest);
        });
    reference.ofRadius_[radius] = {found.values, found.uncertainty};
    if (radius == base.radius) reference.name_ = nameOf(found, body, base.method, first);
  }
  return reference;
}

const Reference::Values* Reference::find(const Setting& setting) const {
  const auto found = ofRadius_.find(isForAllRadii_ ? 0 : setting.radius);
  return found == ofRadius_.end() ? nullptr : &found->second;
}

double Reference::errorOf(const Answer& answer, const Setting& setting) const {
  if (answer.exact.size() > 0) return relativeError(answer, answer.values, answer.exact);
  const Values* found = find(setting);
  return found ? relativeError(answer, answer.values, found->values) : std::nan("");
}

double Reference::uncertainty(const Setting& setting) const {
  const Values* found = find(setting);
  return found ? found->uncertainty : 0;
}

ComplianceTable readCompliances(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  ComplianceTable table;
  std::vector<double> values;
  std::string line;
  bool hasNames = false;
  for (int row = 1; std::getline(file, line); ++row) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
    if (words.empty() || words.front()[0] == '#') continue;
    std::vector<double> numbers;
    for (const std::string& word : words) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end == '\0' && std::isfinite(value)) numbers.push_back(value);
    }
    if (numbers.empty() && !hasNames && table.points.empty()) {
      hasNames = true;  // of the columns
      continue;
    }
    if (numbers.size() != 12 || words.size() != 12)
      throw std::runtime_error(path + ", line " + std::to_string(row) +
                               ": expected twelve finite numbers, x,y,z,cxx,cxy,cxz,cyx,cyy,cyz,"
                               "czx,czy,czz, and found " +
                               std::to_string(numbers.size()) + " in " +
                               std::to_string(words.size()) + " fields");
    if (std::all_of(numbers.begin() + 3, numbers.end(), [](double value) { return value == 0; }))
      throw std::runtime_error(path + ", line " + std::to_string(row) +
                               ": a compliance of zero has no relative error");
    table.points.insert(table.points.end(), numbers.begin(), numbers.begin() + 3);
    for (int column = 0; column < 3; ++column)
      for (int i = 0; i < 3; ++i) values.push_back(numbers[3 + 3 * i + column]);
  }
  if (values.empty()) throw std::runtime_error(path + " holds no compliance");
  table.values = Eigen::Map<Eigen::VectorXd>(values.data(), values.size());
  return table;
}

}  // namespace palpate::app
