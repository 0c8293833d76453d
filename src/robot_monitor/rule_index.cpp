#include "robot_monitor/rule_index.h"

#include "common/cancel_point.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kRulesPerWord = 64;

}  // namespace

const RuleIndex::Matches& RuleIndex::of(const std::string& body) {
  if (known_)
    if (const auto known = known_->find(body); known != known_->end()) return known->second;
  const auto [place, is_new] = found_.try_emplace(body);
  Matches& found = place->second;
  if (!is_new) return found;
  checkCancelled();
  const std::size_t words = (rules_.size() + kRulesPerWord - 1) / kRulesPerWord;
  found.a.assign(words, 0);
  found.b.assign(words, 0);
  const bool is_protected = permissions_.isProtected(body);
  for (std::size_t r = 0; r < rules_.size(); ++r) {
    const RequestRule& rule = rules_[r];
    if (is_protected && rule.is_allowed) continue;
    const std::uint64_t bit = std::uint64_t{1} << (r % kRulesPerWord);
    if (matches(rule.pair.a, body)) found.a[r / kRulesPerWord] |= bit;
    if (matches(rule.pair.b, body)) found.b[r / kRulesPerWord] |= bit;
  }
  return found;
}

const RequestRule* RuleIndex::last(const std::string& body_a, const std::string& body_b) {
  if (rules_.empty()) return nullptr;
  const Matches &a = of(body_a), &b = of(body_b);  // references into the map stay valid
  for (std::size_t word = a.a.size(); word-- > 0;) {
    std::uint64_t both = (a.a[word] & b.b[word]) | (a.b[word] & b.a[word]);
    if (both == 0) continue;
    std::size_t r = word * kRulesPerWord;
    while (both >>= 1) ++r;
    return &rules_[r];
  }
  return nullptr;
}

}  // namespace sdf_ccd
