#pragma once

#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "ros/messages/pair_states.h"
#include "ros/messages/robot_box.h"

namespace sdf_ccd {

/// Draws a planned motion: ghosts of the links that move, at its begin, its end and times between, a line along which
/// each goes, and when and about where the first contact is. Namespaces: ghosts, paths, first_contact.
class PlannedMarkers {
 public:
  static constexpr int kGhosts = 6;  ///< of each link, besides those at the first contact

  explicit PlannedMarkers(const SceneDescription& scene) : scene_(scene) {}

  /// The motion's next piece; some of its poses are kept.
  void add(const CycleMotion& piece);

  /// Of the whole motion; begins with the deletion of what was drawn before.
  /// @param ends  what the results refer to.
  visualization_msgs::MarkerArray draw(const CycleResult& result, const CycleContext& ends,
                                       const std::string& fixed_frame) const;

 private:
  bool moves(std::size_t body) const;
  Isometry3d poseAt(std::size_t body, double time) const;
  Vector3d placeOf(const PairResult& pair) const;
  void drawGhost(std::size_t body, const Isometry3d& X_WB, const std_msgs::ColorRGBA& color,
                 visualization_msgs::MarkerArray& markers) const;

  const SceneDescription& scene_;
  CycleMotion motion_;
};

}  // namespace sdf_ccd
