#include "common/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace sdf_ccd {
namespace {

constexpr std::size_t kLongest = 64;  // letters compared: the cost is their product

std::string lowerCase(std::string text) {
  text.resize(std::min(text.size(), kLongest));
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Optimal string alignment: Damerau and Levenshtein's distance in which no letter is changed twice.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> two_before, before(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) before[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({before[j] + 1, now[j - 1] + 1, before[j - 1] + (a[i - 1] != b[j - 1])});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) now[j] = std::min(now[j], two_before[j - 2] + 1);
    }
    two_before = before;
    before = now;
  }
  return before.back();
}

}  // namespace

std::string nearestName(const std::string& name, const std::set<std::string>& known) {
  const std::string wanted = lowerCase(name);
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, wanted.size() / 2) + 1;
  for (const std::string& candidate : known) {
    const std::string other = lowerCase(candidate);
    const std::size_t distance = editDistance(wanted, other);
    if (distance >= least || distance >= std::max(wanted.size(), other.size())) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string suggestion(const std::string& name, const std::set<std::string>& known) {
  const std::string nearest = nearestName(name, known);
  if (!nearest.empty()) return ", did you mean " + nearest + "?";
  if (known.empty()) return "";
  std::string text;
  for (auto each = known.begin(); each != known.end(); ++each) {
    const bool is_last = std::next(each) == known.end();
    text += (text.empty() ? ", known names: " : is_last ? " and " : ", ") + *each;
  }
  return text;
}

}  // namespace sdf_ccd
