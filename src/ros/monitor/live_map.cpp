#include "ros/monitor/live_map.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <ros/console.h>

#include "common/number_text.h"
#include "common/seconds_since.h"
#include "common/shown_text.h"
#include "field/uniform/sparse_grid.h"
#include "monitor/voxel_mask.h"
#include "ros/monitor/low_priority.h"
#include "ros/tf/seconds_between.h"
#include "ros/world/world_bodies.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
const ros::WallDuration kPatience(0.1);  // longest wait for transforms at the map's stamp
const ros::WallDuration kAgain(0.2);     // between tests for transforms that were missing for a map
constexpr std::chrono::milliseconds kLook(2);
constexpr double kShortestLook = 0.02, kLongestLook = 1.0;  // between tests of the map's age [s]

}  // namespace

LiveMap::LiveMap(const ros::NodeHandle& node, const MonitorParameters& parameters, SceneEditor& editor,
                 const TfHistory& history, const std::atomic<bool>& stop)
    : parameters_(parameters.live_map), editor_(editor), history_(history), stop_(stop) {
  options_.unknown = parameters_.unknown;
  options_.near_distance = parameters_.unknown_distance;
  options_.padding = parameters_.padding;
  options_.band = 1.1 * (parameters.scene.shell.spacing + parameters.scene.motion_margin);
  ros::NodeHandle own(node);
  own.setCallbackQueue(&queue_);
  const boost::function<void(const octomap_msgs::Octomap::ConstPtr&)> hear =
      [this](const octomap_msgs::Octomap::ConstPtr& message) {
        work("A map is not taken, and the last one stays", [&] {
          take(*message);
          taken_ = ros::Time::now();
          last_ = unknown_ > 0 ? message : nullptr;
        });
      };
  subscriber_ = own.subscribe<octomap_msgs::Octomap>(parameters_.topic, 1, hear);
  if (parameters_.max_age > 0.0) {
    const ros::WallDuration look(std::clamp(0.2 * parameters_.max_age, kShortestLook, kLongestLook));
    age_timer_ = own.createWallTimer(
        look, [this](const ros::WallTimerEvent&) { work("A map that is too old stays", [this] { watchAge(); }); });
  }
  again_timer_ = own.createWallTimer(
      kAgain, [this](const ros::WallTimerEvent&) { work("A map is not taken again", [this] { takeAgain(); }); });
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
}

LiveMap::~LiveMap() {
  queue_.disable();
  spinner_->stop();
}

void LiveMap::work(const char* what, const std::function<void()>& job) const {
  lowerPriority();
  const CancelScope scope(stop_);
  try {
    job();
  } catch (const Cancelled&) {
    // The monitor ends.
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(5.0, "%s: %s", what, error.what());
  }
}

/// Otherwise a map would be trusted forever after its publisher has ended.
void LiveMap::watchAge() {
  const ros::Time now = ros::Time::now();
  if (now < taken_) taken_ = now;  // time has jumped
  if (in_scene_ == InScene::kAwaited || secondsBetween(taken_, now) <= parameters_.max_age) return;
  const std::string why = "the last map on " + parameters_.topic + " is older than " + numberText(parameters_.max_age) +
                          " s (octomap/max_age)";
  editor_.setMap({awaitedTile(history_.fixedFrame(), why)}, {});
  in_scene_ = InScene::kAwaited;
  ROS_WARN("%s: the robot is not checked against it", why.c_str());
}

void LiveMap::takeAgain() {
  if (!last_ || in_scene_ == InScene::kAwaited) return;
  if (robotAt(*editor_.world(), *last_, ros::WallDuration()).unknown() >= unknown_) return;
  take(*last_);
  if (unknown_ == 0) last_.reset();
}

std::string LiveMap::frameOf(const octomap_msgs::Octomap& message) const {
  const std::string frame = withoutLeadingSlash(message.header.frame_id);
  return frame.empty() ? history_.fixedFrame() : frame;
}

void LiveMap::take(const octomap_msgs::Octomap& message) {
  const auto start = std::chrono::steady_clock::now();
  if (message.data.size() > kMaxBytes) throw std::runtime_error("it is larger than 256 MiB");
  const std::string frame = frameOf(message);
  if (frame.size() > RequestLimits().name || frame != shownText(frame)) throw std::runtime_error("its frame is none");
  VoxelMapOptions options = options_;
  options.band += 1.1 * kHalfSqrt3 * 0.5 * message.resolution;
  VoxelGrid grid(message.resolution, options);
  grid.addOctree(message.data.data(), message.data.size(), message.id, message.binary != 0);
  const std::shared_ptr<const CheckedWorld> world = editor_.world();
  const RobotPoses poses = robotAt(*world, message, kPatience);
  const std::vector<VoxelMask> masks = masksOf(*world, poses);
  const double read = secondsSince(start);
  const auto isBehind = [this] {
    if (in_scene_ == InScene::kTiles) in_scene_ = InScene::kOther;
  };
  if (!map_ || frame != frame_ || message.resolution != resolution_) {
    map_ = std::make_unique<VoxelMap>(LiveMapParameters::kName, frame, options);
    frame_ = frame;
    resolution_ = message.resolution;
    tiles_.clear();
    isBehind();
  }
  VoxelMap::Change change;
  editor_.arena().execute([&, cancel = CancelPoint()] {
    const CancelScope scope(cancel);
    change = map_->take(std::move(grid), masks);
  });
  for (const std::string& name : change.removed) tiles_.erase(name);
  const std::size_t made = change.made.size();
  std::vector<MadeField> fields;
  for (std::size_t i = 0; i < made; ++i)
    fields.push_back({std::get<std::shared_ptr<const TriangleMesh>>(change.made[i].geometry.front().shape),
                      std::move(change.fields[i])});
  for (BodyDescription& tile : change.made) tiles_[tile.name] = std::move(tile);
  const double built = secondsSince(start);
  std::vector<BodyDescription> tiles;
  tiles.reserve(tiles_.size());
  for (const auto& [name, tile] : tiles_) tiles.push_back(tile);
  std::uint64_t version = world->version();
  if (made > 0 || !change.removed.empty() || in_scene_ != InScene::kTiles) {
    isBehind();  // if setMap() fails, the next map tries again
    version = editor_.setMap(std::move(tiles), fields);
    in_scene_ = InScene::kTiles;
  }
  unknown_ = poses.unknown();
  ROS_INFO_THROTTLE(
      10.0,
      "Map: %zu voxels in %zu tiles, %zu of them new, %zu voxels are the robot's; scene version %lu after "
      "%.1f ms (reading %.1f, tiles %.1f)",
      change.occupied, tiles_.size(), made, change.masked, static_cast<unsigned long>(version),
      1e3 * secondsSince(start), 1e3 * read, 1e3 * (built - read));
}

/// The poses in tf at the map's stamp; those that are missing there, at the present time.
LiveMap::RobotPoses LiveMap::robotAt(const CheckedWorld& world, const octomap_msgs::Octomap& message,
                                     const ros::WallDuration& patience) const {
  RobotPoses poses;
  std::vector<TrackedBody> tracked = {{frameOf(message), Isometry3d::Identity(), {}}};
  for (std::size_t b = 0; b < world.bodies.size(); ++b) {
    if (world.scene().bodies[b].is_world) continue;
    poses.bodies.push_back(b);
    tracked.push_back(world.bodies[b]);
  }
  const auto areKnown = [&] {
    poses.missing.clear();
    posesAt(history_, tracked, message.header.stamp, poses.X_W, poses.missing);
    return poses.unknown() == 0;
  };
  const ros::WallTime end = ros::WallTime::now() + patience;
  while (!areKnown() && ros::WallTime::now() < end) {
    checkCancelled();
    std::this_thread::sleep_for(kLook);
  }
  std::vector<Isometry3d> X_W_now;
  std::vector<std::string> missing_now;
  posesAt(history_, tracked, ros::Time(), X_W_now, missing_now);
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    if (poses.missing[i].empty()) continue;
    poses.X_W[i] = X_W_now[i];
    poses.missing[i] = missing_now[i];
  }
  return poses;
}

/// Number of unknown poses; all of them if the map's own pose is unknown.
std::size_t LiveMap::RobotPoses::unknown() const {
  if (!missing.front().empty()) return missing.size();
  return std::count_if(missing.begin(), missing.end(), [](const std::string& why) { return !why.empty(); });
}

/// The voxels that the robot occupies, as far as its poses are known.
std::vector<VoxelMask> LiveMap::masksOf(const CheckedWorld& world, const RobotPoses& poses) {
  if (!poses.missing.front().empty()) {
    ROS_WARN_THROTTLE(10.0, "The robot's own voxels in a map are not known: %s", poses.missing.front().c_str());
    return {};
  }
  std::vector<VoxelMask> masks;
  for (std::size_t i = 0; i < poses.bodies.size(); ++i) {
    const Body& body = world.scene().bodies[poses.bodies[i]];
    const BodyDescription& description = world.description().bodies[poses.bodies[i]];
    if (!poses.missing[i + 1].empty() || !body.failure.empty() || description.geometry.empty()) continue;
    if (auto mask = maskOf(body, description, poses.X_W[i + 1].inverse() * poses.X_W[0])) {
      masks.push_back(std::move(*mask));
    } else {
      ROS_WARN_ONCE("Voxels that %s fills count, as it has no field: no other link is checked against it",
                    body.name.c_str());
    }
  }
  return masks;
}

}  // namespace sdf_ccd
