// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/bulk_data.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>

#include "text_lines.h"

namespace palpate::imported {
namespace {

constexpr std::int64_t kMostNode = std::int64_t(1) << 48;

std::string_view trimmed(std::string_view field) {
  const std::vector<std::string_view> words = wordsOf(field);
  if (words.empty()) return {};
  return {words.front().data(), static_cast<std::size_t>(words.back().data() + words.back().size() -
                                                         words.front().data())};
}

/// A line with its tabs as the blanks that they stand for.
std::string withoutTabs(std::string_view line) {
  std::string text;
  for (char c : line) {
    if (c == '\t')
      text.append(8 - text.size() % 8, ' ');
    else
      text.push_back(c);
  }
  return text;
}

/// A card with its continuations: what stands in its fields but the first of each line.
struct Card {
  std::string name;
  std::vector<std::string> fields;

  std::string_view operator[](std::size_t i) const {
    return i < fields.size() ? std::string_view(fields[i]) : std::string_view();
  }
};

/// The fields of a line, the first its name: nine of eight characters, five of which four have
/// sixteen, or what commas part.
std::vector<std::string_view> fieldsOf(const TextLines& lines, std::string_view line) {
  std::vector<std::string_view> fields;
  const bool isFree = line.find(',') != line.npos;
  if (isFree) {
    fields = wordsOf(line, ',');
  } else {
    fields.push_back(trimmed(line.substr(0, 8)));
  }
  const bool isLarge = !fields[0].empty() && (fields[0].back() == '*' || fields[0].front() == '*');
  const std::size_t count = isLarge ? 4 : 8, width = isLarge ? 16 : 8;
  for (std::size_t i = 0; !isFree && i < count; ++i) {
    const std::size_t at = 8 + i * width;
    fields.push_back(at < line.size() ? trimmed(line.substr(at, width)) : std::string_view());
  }
  const bool isLonger = fields.size() > count + 1 && !fields[count + 1].empty() &&
                        fields[count + 1].front() != '+' && fields[count + 1].front() != '*';
  if (fields.size() > count + 2 || isLonger)
    lines.refuse("there are more than ", count,
                 " fields between commas: continue on the next line");
  fields.resize(count + 1);  // what is behind is a mark of the continuation
  return fields;
}

/// Calls `use` with each card whose name is wanted; lines are at its end then.
void forEachCard(TextLines& lines, const std::set<std::string>& wanted,
                 const std::function<void(const Card&)>& use) {
  Card card;
  const auto finish = [&] {
    if (wanted.count(card.name)) use(card);
    card = {};
  };
  while (lines.next()) {
    const std::string line = withoutTabs(lines.line().substr(0, lines.line().find('$')));
    const std::vector<std::string_view> fields = fieldsOf(lines, line);
    const bool isBlank = std::all_of(fields.begin(), fields.end(),
                                     [](std::string_view field) { return field.empty(); });
    if (isBlank) continue;
    const bool goesOn = fields[0].empty() || fields[0].front() == '+' || fields[0].front() == '*';
    if (!goesOn) {
      finish();
      for (char c : fields[0])
        if (c != '*') card.name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      if (card.name == "ENDDATA") return;
    }
    if (wanted.count(card.name))
      card.fields.insert(card.fields.end(), fields.begin() + 1, fields.end());
  }
  finish();
}

/// NASTRAN leaves out the E of an exponent: 2.5+10.
double realOf(const TextLines& lines, std::string_view field) {
  std::string text(field);
  const std::size_t sign = text.find_last_of("+-");
  if (sign != text.npos && sign > 0 && text.find_first_of("eEdD") == text.npos)
    text.insert(sign, "e");
  if (!numberOf(text)) lines.refuse("the field ", shown(field), " is not a number");
  return lines.number(text);
}

std::int64_t integerOf(const TextLines& lines, std::string_view field, std::int64_t least,
                       std::int64_t most, std::int64_t ifEmpty) {
  if (field.empty() && ifEmpty >= least) return ifEmpty;
  if (field.empty()) lines.refuse("a field for a whole number is empty");
  return lines.wholeNumber(field, least, most);
}

std::string namesOf(const std::map<std::string, int>& forms) {
  std::string names;
  for (const auto& [name, form] : forms) names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// The forms of the matrices by name.
std::map<std::string, int> formsOf(std::string_view bytes, const std::string& path) {
  std::map<std::string, int> forms;
  TextLines lines(bytes, path);
  forEachCard(lines, {"DMIG"}, [&](const Card& card) {
    if (card[1] != "0") return;
    const auto form = static_cast<int>(integerOf(lines, card[2], 1, 9, -1));
    if (!forms.emplace(card[0], form).second)
      lines.refuse("the matrix ", shown(card[0]), " has two headers");
  });
  return forms;
}

std::string chosenName(const std::map<std::string, int>& forms, const std::string& path,
                       const std::string& wanted) {
  if (forms.empty()) refuse(path, ": no DMIG card is the header of a matrix");
  if (!wanted.empty()) {
    if (!forms.count(wanted))
      refuse(path, ": there is no matrix ", shown(wanted), " but ", namesOf(forms));
    return wanted;
  }
  if (forms.size() == 1) return forms.begin()->first;
  std::string chosen;
  int count = 0;
  for (const auto& [name, form] : forms)
    if (name.front() == 'K' || name.front() == 'k') chosen = name, ++count;
  if (count != 1)
    refuse(path, ": there are several matrices, ", namesOf(forms), ": say which one is meant");
  return chosen;
}

/// The entries of one matrix, its rows by what they belong to.
class DmigColumns {
 public:
  DmigColumns(std::string name, int form) : name_(std::move(name)), form_(form) {}

  void add(const TextLines& lines, const Card& card) {
    if (card[0] != name_) return;
    if (card[1] == "0") {
      const auto type = integerOf(lines, card[3], 1, 4, -1);
      if (type > 2)
        lines.refuse("the matrix ", shown(name_), " is complex: only real ones are elastic");
      return;
    }
    const int column = dof(lines, card[1], card[2]);
    columns_.insert(column);
    for (std::size_t at = 4; at < card.fields.size(); at += 4) {
      if (card[at].empty() && card[at + 1].empty() && card[at + 2].empty()) continue;
      const int row = dof(lines, card[at], card[at + 1]);
      if (!card[at + 3].empty() && realOf(lines, card[at + 3]) != 0)
        lines.refuse("the matrix ", shown(name_), " has an imaginary entry");
      entries_.emplace_back(row, column, realOf(lines, card[at + 2]));
      rows_.insert(row);
    }
  }

  GivenMatrix matrix(const std::string& path) {
    if (entries_.empty()) refuse(path, ": the matrix ", shown(name_), " has no entries");
    if (form_ != 1 && form_ != 6 && rows_ != columns_)
      refuse(path, ": the rectangular matrix ", shown(name_), " (form ", form_,
             ") has other columns than rows: export it as a symmetric one (form 6)");
    const auto size = static_cast<int>(dofs_.size());
    GivenMatrix matrix(size, std::move(entries_), form_ == 6, "NASTRAN DMIG " + name_, path);
    matrix.dofs = std::move(dofs_);
    return matrix;
  }

 private:
  int dof(const TextLines& lines, std::string_view node, std::string_view component) {
    const MatrixDof dof{integerOf(lines, node, 1, kMostNode, -1),
                        static_cast<int>(integerOf(lines, component, 0, 6, 0)) - 1};
    const auto [found, isNew] =
        places_.emplace(std::pair(dof.node, dof.component), static_cast<int>(dofs_.size()));
    if (isNew) dofs_.push_back(dof);
    return found->second;
  }

  std::string name_;
  int form_;
  std::map<std::pair<std::int64_t, int>, int> places_;
  std::vector<MatrixDof> dofs_;
  std::vector<GivenMatrix::Entry> entries_;
  std::set<int> rows_, columns_;
};

NodeTable gridPoints(std::string_view bytes, const std::string& path,
                     const std::function<bool(std::int64_t)>& isWanted) {
  TextLines lines(bytes, path);
  std::map<std::int64_t, Eigen::Vector3d> points;
  forEachCard(lines, {"GRID", "GRDSET"}, [&](const Card& card) {
    const bool isDefault = card.name == "GRDSET";
    const std::int64_t number = isDefault ? 0 : integerOf(lines, card[0], 1, kMostNode, -1);
    if (!isDefault && !isWanted(number)) return;
    for (std::size_t field : {1, 5})
      if (integerOf(lines, card[field], -1, kMostNode, 0) != 0)
        lines.refuse(isDefault ? "grid points are" : sentence("grid point ", number, " is"),
                     " in a frame of their own (", field == 1 ? "CP " : "CD ", card[field],
                     "): export places and components in the basic frame");
    if (isDefault) return;
    Eigen::Vector3d x;
    for (int c = 0; c < 3; ++c) x[c] = card[2 + c].empty() ? 0 : realOf(lines, card[2 + c]);
    if (!points.emplace(number, x).second) lines.refuse("grid point ", number, " is given twice");
  });
  NodeTable nodes;
  nodes.points.resize(3, points.size());
  for (const auto& [number, x] : points) {
    nodes.points.col(nodes.numbers.size()) = x;
    nodes.numbers.push_back(number);
  }
  return nodes;
}

}  // namespace

bool hasCard(std::string_view bytes, std::string_view name) {
  TextLines lines(bytes, "");
  while (lines.next()) {
    const std::string_view line = lines.line();
    if (line.size() < name.size()) continue;
    const bool isNamed =
        std::equal(name.begin(), name.end(), line.begin(), [](char wanted, char given) {
          return std::toupper(static_cast<unsigned char>(given)) == wanted;
        });
    const char next = line.size() > name.size() ? line[name.size()] : ' ';
    if (isNamed && std::string_view(" *,\t").find(next) != std::string_view::npos) return true;
  }
  return false;
}

GivenMatrix readDmig(std::string_view bytes, const std::string& path, const std::string& name) {
  const std::map<std::string, int> forms = formsOf(bytes, path);
  const std::string chosen = chosenName(forms, path, name);
  DmigColumns columns(chosen, forms.at(chosen));
  TextLines lines(bytes, path);
  forEachCard(lines, {"DMIG"}, [&](const Card& card) { columns.add(lines, card); });
  GivenMatrix matrix = columns.matrix(path);
  std::set<std::int64_t> used;
  for (const MatrixDof& dof : matrix.dofs) used.insert(dof.node);
  matrix.nodes = gridPoints(bytes, path, [&](std::int64_t node) { return used.count(node) > 0; });
  return matrix;
}

NodeTable readGridPoints(std::string_view bytes, const std::string& path) {
  return gridPoints(bytes, path, [](std::int64_t) { return true; });
}

}  // namespace palpate::imported
