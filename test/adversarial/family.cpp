#include "adversarial/family.h"

#include <algorithm>

namespace sdf_ccd::test {
namespace {

constexpr std::size_t kRatios = 1'000'000;

}  // namespace

Tally& Tally::operator+=(const Tally& other) {
  cases += other.cases;
  clear += other.clear;
  contact += other.contact;
  uncertain += other.uncertain;
  not_checked += other.not_checked;
  false_clear += other.false_clear;
  false_contact += other.false_contact;
  false_bound += other.false_bound;
  opposite += other.opposite;
  near += other.near;
  placed += other.placed;
  deepest = std::max(deepest, other.deepest);
  const std::size_t room = kRatios - std::min(kRatios, bound_over_error.size());
  const std::size_t taken = std::min(room, other.bound_over_error.size());
  bound_over_error.insert(bound_over_error.end(), other.bound_over_error.begin(),
                          other.bound_over_error.begin() + long(taken));
  for (const auto& [what, failure] : other.failures) {
    Failure& here = failures.try_emplace(what, Failure{0, failure.first}).first->second;
    here.count += failure.count;
  }
  return *this;
}

void Tally::fail(const std::string& what, const std::string& figures) {
  ++failures.try_emplace(what, Failure{0, figures}).first->second.count;
}

double Tally::medianBoundOverError() const {
  if (bound_over_error.empty()) return 0.0;
  std::vector<float> ratios = bound_over_error;
  std::nth_element(ratios.begin(), ratios.begin() + long(ratios.size() / 2), ratios.end());
  return ratios[ratios.size() / 2];
}

std::vector<Family> families() {
  return {{"both_move", bothMove, 4000},      {"degenerate", degenerate, 3000}, {"topology", topology, 1500},
          {"metamorphic", metamorphic, 2000}, {"search", search, 4000},         {"parts", parts, 6000}};
}

}  // namespace sdf_ccd::test
