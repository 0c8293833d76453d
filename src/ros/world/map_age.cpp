#include "ros/world/map_age.h"

#include "common/number_text.h"
#include "ros/world/checked_world.h"

namespace sdf_ccd {

MapAge::MapAge(std::string topic, double max_age, const ros::Time& received)
    : text_("the last map on " + std::move(topic) + " is older than " + numberText(max_age) + " s (octomap/max_age)"),
      max_age_(max_age),
      received_(static_cast<std::int64_t>(received.toNSec())) {}

void MapAge::set(const ros::Time& received) {
  received_ = static_cast<std::int64_t>(received.toNSec());
}

bool MapAge::isTooOld(const ros::Time& now) {
  const auto time = static_cast<std::int64_t>(now.toNSec());
  const std::int64_t age = time - received_;
  if (age < 0) received_ = time;  // time has jumped
  return 1e-9 * static_cast<double>(age) > max_age_;
}

void addOutdatedMap(const CheckedWorld& world, const ros::Time& now, std::vector<std::string>& missing) {
  if (!world.map_age || !world.map_age->isTooOld(now)) return;
  const BodyList& bodies = world.scene().bodies;
  bool has_tiles = false;
  for (const Body& body : bodies) has_tiles |= !body.map.empty();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if ((!has_tiles || !bodies[b].map.empty()) && missing[b].empty()) missing[b] = world.map_age->text();
}

}  // namespace sdf_ccd
