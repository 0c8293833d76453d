#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "monitor/map/voxel_mask.h"
#include "robot_monitor/changing_scene.h"
#include "ros/tf/tf_tracker.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Number of pairs that requests allow to touch, by rules or by touch_links.
inline std::size_t allowedByRequests(const SceneDescription& description) {
  return static_cast<std::size_t>(std::count_if(
      description.allowed.begin(), description.allowed.end(),
      [](const PairDecision& pair) { return pair.kind == PairKind::kRequest || pair.kind == PairKind::kTouchLinks; }));
}

/// A version of the world and the data about it that the core does not hold; immutable, shared by cycles and queries.
struct CheckedWorld {
  std::shared_ptr<const WorldSnapshot> snapshot;
  std::map<std::string, ros::Time> attached_since;  ///< per object that was attached to a link: where it is since then
  std::map<std::string, std::uint64_t> declared;    ///< ObjectMask::declared per object; 0 if it is not listed
  std::vector<TrackedBody> bodies;
  double mask_error;                ///< maskError()
  std::size_t allowed_by_requests;  ///< allowedByRequests()
  std::shared_ptr<MapAge> map_age;  ///< of its live map; null if it has none, or one that never gets too old

  explicit CheckedWorld(std::shared_ptr<const WorldSnapshot> of_snapshot, const ChangingScene::Objects& objects = {})
      : snapshot(std::move(of_snapshot)),
        bodies(trackedBodies(*snapshot->scene)),
        mask_error(maskError(*snapshot->scene)),
        allowed_by_requests(allowedByRequests(*snapshot->description)) {
    for (const auto& [name, object] : objects) {
      declared.emplace(name, object.declared);
      if (!object.link.empty())
        attached_since.emplace(name, ros::Time().fromNSec(static_cast<std::uint64_t>(object.attached_since.count())));
    }
  }

  std::uint64_t version() const { return snapshot->version; }
  const Scene& scene() const { return *snapshot->scene; }
  const SceneDescription& description() const { return *snapshot->description; }
};

/// The world of a scene that nothing has changed yet: version 1.
inline std::shared_ptr<const CheckedWorld> firstWorld(std::shared_ptr<const Scene> scene,
                                                      const SceneDescription& description) {
  auto snapshot = std::make_shared<WorldSnapshot>();
  snapshot->version = 1;
  snapshot->scene = std::move(scene);
  snapshot->description = std::make_shared<const SceneDescription>(description);
  return std::make_shared<const CheckedWorld>(std::move(snapshot));
}

}  // namespace sdf_ccd
