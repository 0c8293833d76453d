#include "rest_overlaps.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "common/counted.h"
#include "common/number_text.h"
#include "model/name_pair.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kNamed = 6, kLines = 100;  // at most so many pairs in a sentence, and in the lines below it

using Overlaps = std::vector<RestOverlap>;

/// Certain ones first, the deepest of them first.
Overlaps inOrder(Overlaps pairs) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const RestOverlap& a, const RestOverlap& b) {
    return std::tuple(a.kind, -a.depth) < std::tuple(b.kind, -b.depth);
  });
  return pairs;
}

Overlaps those(bool are_set_aside, const Overlaps& pairs) {
  Overlaps some;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(some),
               [&](const RestOverlap& pair) { return pair.is_set_aside == are_set_aside; });
  return inOrder(std::move(some));
}

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    xml += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return xml;
}

/// A line of an SRDF for each pair that the user has not named.
std::string srdfLines(const Overlaps& pairs) {
  std::vector<std::string> lines;
  for (const RestOverlap& pair : pairs) {
    if (pair.is_requested) continue;
    lines.push_back("\n<disable_collisions link1=\"" + escaped(pair.link_a) + "\" link2=\"" + escaped(pair.link_b) +
                    "\" reason=\"" + (pair.is_always ? "Always" : "Default") + "\"/>");
  }
  return firstOf(lines, kLines, "", "\nand ");
}

/// " (30 mm)", " (within 1 mm)", " (may overlap)"; empty for an overlap whose depth is not known.
std::string restText(const RestOverlap& pair) {
  switch (pair.kind) {
    case RestOverlap::Kind::kTouching:
      return " (within 1 mm)";
    case RestOverlap::Kind::kOpen:
      return " (may overlap)";
    case RestOverlap::Kind::kOverlap:
      break;
  }
  return pair.depth > 0.0 ? " (" + lengthText(pair.depth) + ")" : "";
}

/// "3 pairs that overlap at rest are WHAT: a - b (30 mm), ...".
std::string sentence(const Overlaps& pairs, const std::string& what) {
  std::vector<std::string> names;
  for (const RestOverlap& pair : pairs) names.push_back(pairName(pair.link_a, pair.link_b) + restText(pair));
  const bool is_one = pairs.size() == 1;
  return counted(pairs.size(), "pair") + (is_one ? " that overlaps at rest is " : " that overlap at rest are ") + what +
         ": " + firstOf(names, kNamed);
}

}  // namespace

std::string setAsideText(const Overlaps& pairs) {
  const Overlaps set_aside = those(true, pairs);
  if (set_aside.empty()) return {};
  return sentence(set_aside, "set aside") +
         "\nTheir contacts are not seen; checked_pairs, or overlapping_pairs, has them checked. Lines for an SRDF that "
         "make it permanent:" +
         srdfLines(set_aside);
}

std::string checkedOverlapsText(const Overlaps& pairs) {
  const Overlaps checked = those(false, pairs);
  if (checked.empty()) return {};
  const std::string lines = srdfLines(checked);
  return sentence(checked, "checked") +
         (lines.empty()
              ? "\nThis is requested."
              : "\nLines for an SRDF that set them aside, if it is known that these contacts mean nothing:" + lines);
}

std::vector<RestOverlap> overlapsIn(const Scene& scene, const Overlaps& pairs) {
  std::set<NamePair> checked;
  for (const PlannedPair& pair : scene.pairs) {
    const Body &a = scene.bodies[pair.body_a], &b = scene.bodies[pair.body_b];
    if (!a.is_world && !b.is_world) checked.insert(namePair(a.name, b.name));
  }
  Overlaps now;
  for (const RestOverlap& pair : pairs) {
    const bool is_checked = checked.count(namePair(pair.link_a, pair.link_b)) > 0;
    if (!is_checked && !pair.is_set_aside) continue;  // left out by a request
    now.push_back(pair);
    now.back().is_set_aside = !is_checked;
  }
  return now;
}

}  // namespace sdf_ccd
