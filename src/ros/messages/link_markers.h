#pragma once

#include <optional>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "ros/messages/pair_states.h"

namespace sdf_ccd {

/// The links' collision shapes, as they are checked, in the colours of their verdicts; translucent, so that contact
/// points inside are visible. Links in no pair are grey.
class LinkMarkers {
 public:
  explicit LinkMarkers(const SceneDescription& scene);

  /// Colours the links.
  /// @param verdicts  per body (PairStates::ofBodies()).
  /// @return whether anything has changed since the last call.
  bool draw(const std::vector<std::optional<Verdict>>& verdicts);

  /// Of all links, as last drawn.
  const visualization_msgs::MarkerArray& markers() const { return markers_; }

 private:
  visualization_msgs::MarkerArray markers_;
  std::vector<int> bodies_;  // per marker: index of its body
  std::vector<std::optional<Verdict>> drawn_;
};

}  // namespace sdf_ccd
