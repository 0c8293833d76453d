#include "ros/messages/status_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "common/number_text.h"
#include "scene/name_pair.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kWidth = 60;           // of a line [characters]
constexpr std::size_t kLongestReason = 180;  // [characters]

/// A lower bound of the distances of all pairs [m]; negative if one of them is not known.
double clearanceOf(const PairStates& states) {
  double clearance = std::numeric_limits<double>::infinity();
  for (const PairState& pair : states.pairs()) clearance = std::min(clearance, pair.clearance);
  return std::isfinite(clearance) ? clearance : -1.0;
}

double depthOf(const PairStates& states, Verdict verdict) {
  double depth = 0.0;
  for (const PairState& pair : states.pairs()) {
    if (pair.verdict == verdict) depth = std::max(depth, pair.depth);
  }
  return depth;
}

/// The pairs that are uncertain: one by name, and the number of the others.
std::string uncertainPairs(const PairStates& states, const CycleResult& result, const CycleContext& cycle) {
  std::size_t count = 0;
  std::string example;
  for (std::size_t i = 0; i < states.pairs().size(); ++i) {
    if (states.pairs()[i].verdict == Verdict::kUncertain && ++count == 1)
      example = pairName(cycle.scene, result.pairs[i]);
  }
  const std::string others = count > 1 ? " and " + std::to_string(count - 1) + " more" : "";
  return wrapped(example.substr(0, kLongestReason) + others, kWidth);
}

std::string headline(const PairStates& states, const CycleResult& result, const CycleContext& cycle) {
  switch (states.verdict()) {
    case Verdict::kContact:
      return (result.incomplete > 0 ? "CONTACT, at least " : "CONTACT, ") +
             lengthText(depthOf(states, Verdict::kContact)) + " deep";
    case Verdict::kUncertain:
      return "UNCERTAIN, within the error bound:\n" + uncertainPairs(states, result, cycle);
    case Verdict::kNotChecked:
      return "NOT CHECKED";
    case Verdict::kClear:
      break;
  }
  const double clearance = clearanceOf(states);
  return clearance > 0.0 ? "CLEAR, at least " + lengthText(clearance) + " apart" : "CLEAR";
}

/// Number of pairs that are not checked, with the reason of one of them; empty if all are checked.
std::string uncheckedPairs(const PairStates& states, const CycleResult& result, const CycleContext& cycle) {
  std::size_t count = 0;
  std::string example;
  for (std::size_t i = 0; i < states.pairs().size(); ++i) {
    if (states.pairs()[i].verdict != Verdict::kNotChecked) continue;
    const PairResult& pair = result.pairs[i];
    if (++count > 1 || pair.reason.empty()) continue;
    example = pairName(cycle.scene, pair) + ": " + pair.reason;
  }
  if (count == 0) return {};
  const std::string total = std::to_string(states.pairs().size());
  return wrapped(std::to_string(count) + " of " + total + " pairs not checked" +
                     (example.empty() ? "" : ": " + example.substr(0, kLongestReason)),
                 kWidth);
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t column = 0;
  while (words >> word) {
    for (; word.size() > width; word.erase(0, width)) {
      result += (result.empty() ? "" : "\n") + word.substr(0, width);
      column = width;
    }
    const bool fits = column > 0 && column + 1 + word.size() <= width;
    if (!result.empty()) result += fits ? " " : "\n";
    column = fits ? column + 1 + word.size() : word.size();
    result += word;
  }
  return result;
}

int lineCount(const std::string& text) {
  return 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

std::string statusText(const PairStates& states, const CycleResult& result, const CycleContext& cycle, double age,
                       const std::vector<std::string>& warnings) {
  std::string text = headline(states, result, cycle);
  if (result.checked + result.skipped > 0) {
    constexpr double kLeast = 1e-6;  // [m], of what is shown
    const std::string bound = lengthText(std::max(kLeast, result.error_bound));
    text += fmt::format("\nerror bound {}, {:.2f} s ago", bound, std::max(0.0, age));
  }
  const std::string unchecked = uncheckedPairs(states, result, cycle);
  if (!unchecked.empty()) text += "\n" + unchecked;
  for (const std::string& warning : warnings)
    text += "\n" + wrapped("Warning: " + warning.substr(0, std::min(kLongestReason, warning.find('\n'))), kWidth);
  return text;
}

std::string uncheckedText(const std::string& reason) {
  return "NOT CHECKED\n" + wrapped(reason.substr(0, kLongestReason), kWidth);
}

}  // namespace sdf_ccd
