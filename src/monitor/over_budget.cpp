#include "monitor/over_budget.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "common/counted.h"
#include "common/number_text.h"
#include "model/error_budget.h"
#include "pair_bound.h"
#include "shell/contact_gap.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kNamed = 3;         // at most so many bodies are named
constexpr double kShareRounding = 1.001;  // factor on a share, so that one that is exactly met is not listed

double ownGap(const Body& body) {
  return body.shell->size() > 0 ? contactGap(body.shell, body.shell) : 0.0;
}

/// A body, a source of error, and the text about them.
struct Reason {
  std::pair<std::string, std::string> key;
  std::string text;
};

/// Why the gap between the points of a pair exceeds its share.
Reason gapReason(const Scene& scene, const PlannedPair& pair, double gap, double share) {
  const Body &a = scene.bodies[pair.body_a], &b = scene.bodies[pair.body_b];
  if (pair.a_shell_b_field && pair.b_shell_a_field) {
    const std::string& name = (ownGap(a) > ownGap(b) ? a : b).name;
    return {{name, "gap"}, name + " has gaps of " + lengthText(gap) + " between points, not " + lengthText(share)};
  }
  const std::string& name = (pair.a_shell_b_field ? b : a).name;
  return {{name, "gap"},
          name + " is used only as a field, so the gap of " + lengthText(gap) +
              " between face points applies instead of " + lengthText(share)};
}

/// Why a pair's bound exceeds the required one.
std::vector<Reason> reasons(const Scene& scene, const PlannedPair& pair, const ErrorBudget& budget) {
  const ErrorBound bound = pairBound(scene, pair);
  const Body &a = scene.bodies[pair.body_a], &b = scene.bodies[pair.body_b];
  std::vector<Reason> found;
  const double field = budget.field, gap = budget.edge_gap;
  if (bound.gap > kShareRounding * gap) found.push_back(gapReason(scene, pair, bound.gap, gap));
  if (bound.field > kShareRounding * field) {
    const Body& worse = fieldError(a) > fieldError(b) ? a : b;
    found.push_back(
        {{worse.name, "field"},
         "the field of " + worse.name + " has an error of " + lengthText(bound.field) + ", not " + lengthText(field)});
  }
  return found;
}

}  // namespace

std::string overBudget(const Scene& scene) {
  if (!scene.max_error || scene.bound.total() <= *scene.max_error) return "";
  std::map<std::pair<std::string, std::string>, std::pair<double, std::string>> largest;  // bound and text of the worst
  for (const PlannedPair& pair : scene.pairs) {
    if (trianglesDecide(scene, pair)) continue;
    const double total = pairBound(scene, pair).total() + scene.motion_margin;
    if (total <= *scene.max_error) continue;
    for (const Reason& reason : reasons(scene, pair, divideErrorBudget(*scene.max_error))) {
      auto& known = largest[reason.key];
      if (total > known.first) known = {total, reason.text};
    }
  }
  std::vector<std::pair<double, std::string>> worst;
  for (const auto& [key, bound] : largest) worst.emplace_back(-bound.first, bound.second);
  std::sort(worst.begin(), worst.end());
  std::vector<std::string> texts;
  for (const auto& [bound, text] : worst) texts.push_back(text);
  return "the error bound is " + lengthText(scene.bound.total()) + ", more than the max_error of " +
         lengthText(*scene.max_error) + (texts.empty() ? "" : ": ") + firstOf(texts, kNamed, "; ", "; and ");
}

}  // namespace sdf_ccd
