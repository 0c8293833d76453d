#include "pair_times.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/name_pair.h"

namespace sdf_ccd {

std::string PairTimes::longest(const Scene& scene) const {
  constexpr std::size_t kMost = 3;
  constexpr double kSmall = 0.1;  // a share that is not worth a name
  std::vector<std::pair<std::int64_t, std::size_t>> by_time;
  double all = 0.0;
  for (std::size_t pair = 0; pair < nanoseconds_.size(); ++pair) {
    by_time.emplace_back(nanoseconds_[pair], pair);
    all += static_cast<double>(by_time.back().first);
  }
  std::sort(by_time.rbegin(), by_time.rend());
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, by_time.size()); ++i) {
    const double share = static_cast<double>(by_time[i].first) / all;
    if (!(share > kSmall)) break;
    text += (text.empty() ? "" : ", ") + pairName(scene, scene.pairs[by_time[i].second]) + " (" +
            std::to_string(std::lround(100.0 * share)) + " %)";
  }
  return text;
}

}  // namespace sdf_ccd
