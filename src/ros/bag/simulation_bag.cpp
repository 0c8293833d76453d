#include "ros/bag/simulation_bag.h"

#include <array>

#include <tf2_msgs/TFMessage.h>

#include "ros/messages/conversions.h"
#include "ros/messages/shape_marker.h"

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;

constexpr double kTimeZero = 1.0;   // [s]
constexpr double kPlaneSize = 2.0;  // [m]

// rviz deletes all markers some frames after a bag's time has jumped back to its start.
constexpr double kMarkersOftenUntil = 0.5;  // [s]
constexpr double kMarkersOften = 0.1;       // [s]
constexpr double kMarkersLater = 1.0;       // [s]

/// Colours that are easy to tell apart, one per body in turn; grey for fixed ones.
std_msgs::ColorRGBA colorOf(std::size_t body, bool is_fixed, float alpha) {
  constexpr std::array<std::array<float, 3>, 6> kColors = {{{0.30F, 0.45F, 0.69F},
                                                            {0.87F, 0.52F, 0.32F},
                                                            {0.33F, 0.66F, 0.41F},
                                                            {0.77F, 0.31F, 0.32F},
                                                            {0.51F, 0.45F, 0.70F},
                                                            {0.58F, 0.47F, 0.38F}}};
  const auto& [r, g, b] = kColors[body % kColors.size()];
  return is_fixed ? toColor(0.7F, 0.7F, 0.7F, alpha) : toColor(r, g, b, alpha);
}

Marker toMarker(const SimulationSetup& setup, std::size_t body, const std::string& frame) {
  Marker marker = makeMarker(frame, "bodies", static_cast<int>(body), Marker::CUBE);
  marker.frame_locked = true;
  const TriangleMesh* mesh = setup.meshes[body].get();
  marker.color = colorOf(body, setup.world.bodies[body].fixed, mesh == nullptr ? 0.15F : 1.0F);
  if (mesh != nullptr) {
    setTriangles(*mesh, marker);
  } else {  // a half-space, solid below its z = 0
    marker.scale = toVector3({kPlaneSize, kPlaneSize, 0.001});
    marker.pose.position.z = -0.0005;
  }
  return marker;
}

}  // namespace

SimulationBag::SimulationBag(BagWriter& bag, const SimulationSetup& setup) : bag_(bag) {
  for (std::size_t b = 0; b < setup.world.bodies.size(); ++b) {
    frames_.push_back(setup.world.bodies[b].name);
    markers_.markers.push_back(toMarker(setup, b, frames_[b]));
  }
  const ros::Time stamp(kTimeZero);
  tf2_msgs::TFMessage scene;
  scene.transforms.push_back(
      toTransformStamped({stamp, "world", "scene"}, Isometry3d(Eigen::Translation3d(setup.world.origin_W))));
  bag_.write("/tf_static", stamp, scene);
}

void SimulationBag::add(double time, const std::vector<BodyState>& states) {
  const ros::Time stamp(kTimeZero + time);
  tf2_msgs::TFMessage poses;
  for (std::size_t b = 0; b < states.size(); ++b) {
    poses.transforms.push_back(toTransformStamped({stamp, "scene", frames_[b]}, states[b].X_OB));
  }
  bag_.write("/tf", stamp, poses);
  if (time >= next_markers_) {
    bag_.write("/simulation/bodies", stamp, markers_);
    next_markers_ = time + (time < kMarkersOftenUntil ? kMarkersOften : kMarkersLater);
  }
}

}  // namespace sdf_ccd
