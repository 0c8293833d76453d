#pragma once

#include <optional>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "ros/messages/pair_states.h"

namespace sdf_ccd {

/// The links' collision shapes, which are what is checked, in the colours of their verdicts; translucent, so that
/// contact points show within. Links of no pair are grey.
class LinkMarkers {
 public:
  explicit LinkMarkers(const SceneDescription& scene);

  /// All links. @param verdicts  per body (PairStates::ofBodies()).
  /// @return none if they are as they were last time.
  std::optional<visualization_msgs::MarkerArray> draw(const std::vector<std::optional<Verdict>>& verdicts);

 private:
  visualization_msgs::MarkerArray markers_;
  std::vector<int> bodies_;  // of each marker
  std::vector<std::optional<Verdict>> drawn_;
};

}  // namespace sdf_ccd
