#include "ros/monitor/force_builder.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <set>
#include <utility>

#include <ros/console.h>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "common/seconds_since.h"
#include "ros/monitor/low_priority.h"
#include "ros/tf/tf_tracker.h"
#include "scene/body_builder.h"

namespace sdf_ccd {
namespace {

constexpr std::chrono::milliseconds kPeriod(50);  // between two questions whether forces are wanted

bool isVoxels(const BodyDescription& body) {
  return std::any_of(body.geometry.begin(), body.geometry.end(),
                     [](const GeometryDescription& part) { return part.watertight_voxels; });
}

}  // namespace

void setForces(Forces forces, std::vector<BodyDescription>& bodies) {
  for (BodyDescription& body : bodies)
    if (hasMesh(body) && !isVoxels(body)) body.forces = forces;
}

ForceBuilder::ForceBuilder(SceneEditor& editor, const TfHistory& history, std::function<bool()> is_wanted)
    : editor_(editor), history_(history), is_wanted_(std::move(is_wanted)), thread_([this] { run(); }) {}

ForceBuilder::~ForceBuilder() {
  stop_ = true;
  thread_.join();
}

void ForceBuilder::run() {
  lowerPriority();
  const CancelScope scope(stop_);
  try {
    while (!is_wanted_()) {
      std::this_thread::sleep_for(kPeriod);
      checkCancelled();
    }
    buildAll();
  } catch (const Cancelled&) {
    // The monitor ends.
  } catch (const std::exception& error) {
    ROS_ERROR("Forces of some pairs stay unknown: %s", error.what());
  }
}

void ForceBuilder::buildAll() {
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t pairs = 1;; pairs *= 2) {  // the first forces are there soon, and most versions are saved
    const std::vector<std::string> bodies = nearest(pairs);
    if (bodies.empty()) break;
    editor_.addForces(bodies, arena_);
  }
  ROS_INFO("Forces of all pairs are known after %s", durationText(secondsSince(start)).c_str());
}

/// The bodies without forces of so many pairs; none if all have them.
std::vector<std::string> ForceBuilder::nearest(std::size_t pairs) const {
  const std::shared_ptr<const CheckedWorld> world = editor_.world();
  const BodyList& bodies = world->scene().bodies;
  std::vector<Isometry3d> X_WB;
  std::vector<std::string> missing;
  posesAt(history_, world->bodies, ros::Time(), X_WB, missing);
  const auto awaits = [&](int body) { return bodies[static_cast<std::size_t>(body)].forces == Forces::kAwaited; };
  const auto gap = [&](const PlannedPair& pair) {
    const auto a = static_cast<std::size_t>(pair.body_a), b = static_cast<std::size_t>(pair.body_b);
    if (!missing[a].empty() || !missing[b].empty()) return 0.0;
    const BoundingBall &ball_a = bodies[a].ball, &ball_b = bodies[b].ball;
    return (X_WB[a] * ball_a.center - X_WB[b] * ball_b.center).norm() - ball_a.radius - ball_b.radius;
  };
  std::vector<std::pair<double, const PlannedPair*>> order;
  for (const PlannedPair& pair : world->scene().pairs)
    if (awaits(pair.body_a) || awaits(pair.body_b)) order.emplace_back(gap(pair), &pair);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  order.resize(std::min(order.size(), pairs));
  std::set<std::string> found;
  for (const auto& [distance, pair] : order)
    for (const int body : {pair->body_a, pair->body_b})
      if (awaits(body)) found.insert(bodies[static_cast<std::size_t>(body)].name);
  if (!found.empty()) return {found.begin(), found.end()};
  for (const Body& body : bodies)  // in no pair: no field is built, but another version of the scene may need it
    if (body.forces == Forces::kAwaited) found.insert(body.name);
  return {found.begin(), found.end()};
}

}  // namespace sdf_ccd
