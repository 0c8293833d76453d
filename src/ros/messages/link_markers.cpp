#include "ros/messages/link_markers.h"

#include "ros/messages/shape_marker.h"

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;

constexpr float kFaint = 0.5F, kStrong = 0.7F;

std_msgs::ColorRGBA linkColor(const std::optional<Verdict>& verdict) {
  if (!verdict) return toColor(0.6F, 0.6F, 0.6F, kFaint);
  return verdictColor(*verdict, *verdict == Verdict::kClear ? kFaint : kStrong);
}

}  // namespace

LinkMarkers::LinkMarkers(const SceneDescription& scene) {
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    const BodyDescription& link = scene.bodies[body];
    if (link.is_world) continue;
    for (std::size_t i = 0; i < link.geometry.size(); ++i) {
      Marker marker = makeMarker(link.frame, link.name, static_cast<int>(i), Marker::CUBE);
      marker.frame_locked = true;
      marker.pose = toPose(link.X_frame_B * link.geometry[i].X_BG);
      setShape(link.geometry[i], marker);
      markers_.markers.push_back(std::move(marker));
      bodies_.push_back(static_cast<int>(body));
    }
  }
}

bool LinkMarkers::draw(const std::vector<std::optional<Verdict>>& verdicts) {
  if (verdicts == drawn_) return false;
  drawn_ = verdicts;
  for (std::size_t i = 0; i < bodies_.size(); ++i) markers_.markers[i].color = linkColor(verdicts[bodies_[i]]);
  return true;
}

}  // namespace sdf_ccd
