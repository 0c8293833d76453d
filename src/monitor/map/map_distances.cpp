#include "map_distances.h"

#include "common/number_text.h"

namespace sdf_ccd {

std::string distancesWithinPadding(const ProximityThresholds& thresholds, double padding) {
  std::string below;
  for (const auto& [name, distance] :
       {std::pair("stop_distance", thresholds.stop), std::pair("warning_distance", thresholds.warning)}) {
    if (distance > 0.0 && distance < padding)
      below += (below.empty() ? "" : " and ") + std::string(name) + " (" + numberText(distance) + " m)";
  }
  if (below.empty()) return {};
  return below + " below octomap/padding (" + numberText(padding) +
         " m): what a live map first shows within the padding of the robot is ignored as its own, and never as near as "
         "that";
}

}  // namespace sdf_ccd
