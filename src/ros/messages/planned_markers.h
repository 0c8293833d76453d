#pragma once

#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "ros/messages/pair_states.h"
#include "ros/messages/robot_box.h"

namespace sdf_ccd {

/// Draws a planned motion: ghosts of the moving links at its start, its end and times between, the path of each of
/// them, and the time and approximate location of the first contact. Namespaces: ghosts, paths, first_contact.
class PlannedMarkers {
 public:
  static constexpr int kGhosts = 6;  ///< per link, without those at the first contact

  explicit PlannedMarkers(const SceneDescription& scene) : scene_(scene) {}

  /// Adds the motion's next piece; only some of its poses are kept.
  void add(const CycleMotion& piece);

  /// Markers of the whole motion; the first one deletes what was drawn before.
  /// @param ends  data that the results refer to.
  visualization_msgs::MarkerArray draw(const CycleResult& result, const CycleContext& ends,
                                       const std::string& fixed_frame) const;

 private:
  bool moves(std::size_t body) const;
  Isometry3d poseAt(std::size_t body, double time) const;
  Vector3d contactLocation(const PairResult& pair) const;
  void drawGhost(std::size_t body, const Isometry3d& X_WB, const std_msgs::ColorRGBA& color,
                 visualization_msgs::MarkerArray& markers) const;

  const SceneDescription& scene_;
  CycleMotion motion_;
};

}  // namespace sdf_ccd
