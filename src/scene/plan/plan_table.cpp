#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "common/counted.h"
#include "common/number_text.h"
#include "scene/name_pair.h"
#include "scene/no_pairs.h"
#include "scene_totals.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {
namespace {

using Row = std::vector<std::string>;

constexpr std::size_t kNamedPairs = 4;    // at most so many examples are named per reason
constexpr std::size_t kNamedDepths = 30;  // where pairs have depths, which is what their reader looks for

/// Number of characters, not bytes, of UTF-8.
std::size_t width(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

/// Columns as wide as their widest entry; the first `left` columns flush left, numbers flush right.
std::string aligned(const std::vector<Row>& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - width(row[c]), ' ');
      line += (c == 0 ? "" : "  ") + (c < left ? row[c] + padding : padding + row[c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

/// One line per kind and reason, with a few examples: "212 pairs, SRDF: Never: a - b, c - d, ...". ASCII, for logs
/// in any locale.
std::string leftOutLines(const Scene& scene) {
  struct Group {
    std::vector<std::string> names;
    std::size_t most = kNamedPairs;
  };
  std::map<std::pair<std::string, std::string>, Group> groups;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodyReport& report = scene.reports[b];
    const auto add = [&](const char* kind, const PartReport& part) {
      if (part.state != PartState::kReady && !part.text.empty()) groups[{kind, part.text}].names.push_back(report.name);
    };
    if (!scene.bodies[b].failure.empty()) continue;
    add("field", report.field);
    add("shell", report.shell);
  }
  for (const PairDecision& pair : scene.left_out) {
    Group& group = groups[{"pair", pair.text}];
    group.names.push_back(pairName(pair.body_a, pair.body_b));
    if (!(pair.depth > 0.0)) continue;
    group.names.back() += " (" + lengthText(pair.depth) + ")";
    group.most = kNamedDepths;
  }
  std::string text;
  for (const auto& [kind, group] : groups) {
    const auto& [names, most] = group;
    text += "  " + counted(names.size(), kind.first) + ", " + kind.second + ": ";
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i == 0 ? "" : ", ") + names[i];
    text += names.size() > most ? ", ...\n" : "\n";
  }
  return text;
}

std::string columnText(const PartReport& part, const std::string& ready) {
  constexpr std::array<const char*, 5> kNames{"left out", "", "awaited", "not wanted", "failed"};
  return part.state == PartState::kReady ? ready : kNames[static_cast<std::size_t>(part.state)];
}

std::string sources(const ErrorSources& bound) {
  return " (field " + fixedText(1e3 * bound.field, 2) + ", gap between points " + fixedText(1e3 * bound.gap, 2) +
         ", motion " + fixedText(1e3 * bound.chord, 2) + ")";
}

/// "error bound of verdicts: 0.04 mm, within the max_error of 0.10 (field 0.00, gap between points 0.00, motion
/// 0.04)", and that of contacts.
std::string boundLines(const Scene& scene) {
  const ErrorSources& bound = scene.bound;
  if (scene.contact_bound.total() == 0.0) return "";
  std::string text = "error bound of verdicts: " + fixedText(1e3 * bound.total(), 2) + " mm";
  if (scene.max_error) {
    const bool reached = bound.total() <= *scene.max_error;
    text += ", " + std::string(reached ? "within" : "MORE than") + " the max_error of " +
            fixedText(1e3 * *scene.max_error, 2);
  }
  return text + sources(bound) + "\nerror bound of contacts' times and of depths at the shells' points: " +
         fixedText(1e3 * scene.contact_bound.total(), 2) + " mm" + sources(scene.contact_bound) + "\n";
}

}  // namespace

std::string planTable(const Scene& scene) {
  std::vector<Row> rows = {
      {"body", "geometry", "field", "cells", "MB", "field mm", "shell points", "gap mm", "bound mm", "pairs"}};
  double megabytes = 0.0;
  std::size_t cells = 0, points = 0;
  for (const BodyReport& report : scene.reports) {
    const double mb = 1e-6 * double(report.field_bytes + report.shell_bytes);
    megabytes += mb;
    cells += report.cells;
    points += report.shell_points;
    const bool has_shell = report.shell_points > 0, has_bound = report.bound.total() > 0.0;
    rows.push_back({report.name, report.geometry, columnText(report.field, report.field.text),
                    std::to_string(report.cells), fixedText(mb, 1), fixedText(1e3 * report.field_error, 2),
                    columnText(report.shell, std::to_string(report.shell_points)),
                    has_shell ? fixedText(1e3 * report.gap, 2) : "",
                    has_bound ? fixedText(1e3 * report.bound.total(), 2) : "", std::to_string(report.pairs)});
  }
  rows.push_back({"total", "", "", std::to_string(cells), fixedText(megabytes, 1), "", std::to_string(points), "",
                  fixedText(1e3 * scene.bound.total(), 2), std::to_string(scene.pairs.size())});
  std::string text = aligned(rows, 3);

  text += boundLines(scene);

  std::string failures, warnings;
  for (const Body& body : scene.bodies)
    if (!body.failure.empty()) failures += "  " + body.name + ": " + body.failure + "\n";
  for (const BodyReport& report : scene.reports)
    for (const std::string& warning : report.warnings) warnings += "  " + report.name + ": " + warning + "\n";
  if (!failures.empty()) text += "not checked:\n" + failures;
  if (!scene.visual_only.empty()) {
    text += "not checked, as they have a visual but no collision shape:\n ";
    for (const std::string& link : scene.visual_only) text += " " + link;
    text += "\n";
  }
  for (const auto* some : {&scene.warnings, &scene.overlap_notes})
    for (const std::string& warning : *some) warnings += "  " + warning + "\n";
  if (const std::string none = whyNoPairs(scene); !none.empty()) warnings += "  " + none + "\n";
  if (!warnings.empty()) text += "notes:\n" + warnings;
  const std::size_t of_objects = pairsOfObjects(scene.bodies);
  const std::string left_out = leftOutLines(scene);
  if (!left_out.empty() || of_objects > 0) text += "left out:\n" + left_out;
  if (of_objects > 0) text += "  " + counted(of_objects, "pair") + " of two objects of the world\n";
  return text;
}

}  // namespace sdf_ccd
