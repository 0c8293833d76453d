#include "robot_masks.h"

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

RobotMasks robotMasks(const Scene& scene, const SceneDescription& description, const std::vector<BodyInMap>& bodies) {
  RobotMasks found;
  for (const BodyInMap& in_map : bodies) {
    const Body& body = scene.bodies[in_map.body];
    const BodyDescription& of_body = description.bodies[in_map.body];
    if (!body.failure.empty() || of_body.geometry.empty()) continue;
    if (auto mask = maskOf(body, of_body, in_map.X_BM)) {
      mask->only_unknown = !in_map.is_at_stamp;
      mask->is_guess = !in_map.is_at_stamp && !in_map.was_elsewhere;
      found.masks.push_back(std::move(*mask));
    } else if (found.without_field.empty()) {
      found.without_field = body.name;
    }
  }
  return found;
}

}  // namespace sdf_ccd
