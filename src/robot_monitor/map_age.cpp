#include "robot_monitor/map_age.h"

#include <algorithm>

#include "common/number_text.h"

namespace sdf_ccd {

MapAge::MapAge(std::string topic, double max_age, Time received)
    : text_("the last map on " + std::move(topic) + " is older than " + numberText(max_age) + " s (octomap/max_age)"),
      max_age_(max_age),
      received_(received) {}

bool MapAge::isTooOld(Time now) {
  const Time age = now - received_.load();
  if (age < Time::zero()) received_ = now;  // time has jumped
  return std::chrono::duration<double>(age).count() > max_age_;
}

void addOutdatedMap(MapAge* age, MapAge::Time now, const BodyList& bodies, std::vector<std::string>& missing) {
  if (!age || !age->isTooOld(now)) return;
  const bool has_tiles = std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return !body.map.empty(); });
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if ((!has_tiles || !bodies[b].map.empty()) && missing[b].empty()) missing[b] = age->text();
}

}  // namespace sdf_ccd
