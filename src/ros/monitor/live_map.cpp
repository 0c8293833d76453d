#include "ros/monitor/live_map.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <ros/console.h>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "common/seconds_since.h"
#include "common/shown_text.h"
#include "field/grid_cell.h"
#include "robot_monitor/awaited_tile.h"
#include "ros/monitor/low_priority.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
constexpr std::chrono::milliseconds kTfPeriod(5);  // between tests for transforms that a map waits for
const ros::WallDuration kMasksPeriod(0.05);        // between tests for objects that move, and poses that were missing
constexpr double kMinAgePeriod = 0.02, kMaxAgePeriod = 1.0;  // between tests of the map's age [s]

}  // namespace

LiveMap::LiveMap(const ros::NodeHandle& node, const MonitorParameters& parameters, SceneEditor& editor,
                 const TfHistory& history, const Place& place, const std::atomic<bool>& stop)
    : parameters_(parameters.live_map),
      max_latency_(parameters.tf.max_latency),
      max_gap_(parameters.tf.max_cycle),
      editor_(editor),
      history_(history),
      stop_(stop),
      frame_watch_(history, place.root_frame),
      warnings_(place.warnings) {
  options_.unknown = parameters_.unknown;
  options_.near_distance = parameters_.unknown_distance;
  options_.padding = parameters_.padding;
  options_.band = 1.1 * (parameters.scene.shell.spacing + parameters.scene.motion_margin);
  ros::NodeHandle own(node);
  own.setCallbackQueue(&queue_);
  using Event = ros::MessageEvent<const octomap_msgs::Octomap>;
  const boost::function<void(const Event&)> receive = [this](const Event& event) {
    run("A map is not used, and the last one stays", [&] {
      const octomap_msgs::Octomap::ConstPtr message = event.getConstMessage();
      const ros::Time stamp(message->header.stamp.sec, message->header.stamp.nsec);  // nsec may exceed one second
      auto robot = std::make_unique<RobotInMap>(history_, frameOf(*message), stamp, max_gap_);
      process(*message, event.getReceiptTime(), *robot, false);
      received_ = ros::Time::now();
      robot_ = std::move(robot);
      incomplete_ = unknown_ > 0 ? message : nullptr;
      incomplete_received_ = event.getReceiptTime();
    });
  };
  ros::SubscribeOptions topic;
  topic.initByFullCallbackType<const Event&>(parameters_.topic, 1, receive);
  subscriber_ = own.subscribe(topic);
  if (parameters_.max_age > 0.0) {
    const ros::WallDuration period(std::clamp(0.2 * parameters_.max_age, kMinAgePeriod, kMaxAgePeriod));
    age_timer_ = own.createWallTimer(period, [this](const ros::WallTimerEvent&) {
      run("A map that is too old is still used", [this] { checkAge(); });
    });
  }
  masks_timer_ = own.createWallTimer(kMasksPeriod, [this](const ros::WallTimerEvent&) {
    run("The last map is not processed again", [this] {
      updateMasks();
      judgeObjects();
    });
  });
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
}

LiveMap::~LiveMap() {
  queue_.disable();
  spinner_->stop();
}

void LiveMap::run(const char* what, const std::function<void()>& job) const {
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
void LiveMap::checkAge() {
  if (in_scene_ == InScene::kAwaited || !age_ || !age_->isTooOld(sinceEpoch(ros::Time::now()))) return;
  editor_.setMap({awaitedTile(history_.fixedFrame(), age_->text())}, {}, nullptr, arena_);
  in_scene_ = InScene::kAwaited;
  ROS_WARN("%s: the robot is not checked against it", age_->text().c_str());
}

/// Processes the last map again if more of the robot's poses are known now.
void LiveMap::updateMasks() {
  if (!incomplete_ || in_scene_ == InScene::kAwaited) return;
  robot_->update(*editor_.world());
  if (robot_->unknown() >= unknown_) return;
  process(*incomplete_, incomplete_received_, *robot_, true);
  if (unknown_ == 0) incomplete_.reset();
}

/// Judges the last map's voxels again if objects of the scene have come or gone, or may have moved away from theirs.
void LiveMap::judgeObjects() {
  if (!map_ || in_scene_ != InScene::kTiles) return;
  const std::shared_ptr<const CheckedWorld> world = editor_.world();
  const ObjectsInMap in_map(history_, *world, frame_);
  const std::vector<std::size_t> objects = in_map.objects();
  const bool may_change = std::any_of(objects.begin(), objects.end(), [&](std::size_t object) {
    return map_->isInMap(in_map.name(object), in_map.declared(object));
  });
  if (world->version() == judged_version_ && !may_change) return;
  const auto masks =
      in_map.masks(ros::Time(), [&](const auto& name, std::uint64_t declared) { return map_->isNew(name, declared); });
  VoxelMap::Change change;
  arena_.run([&] { change = map_->judgeAgain(masks); });
  judged_version_ = world->version();
  if (!change.made.empty() || !change.removed.empty()) apply(change, age_);
}

void LiveMap::waitForTf(const CheckedWorld& world, RobotInMap& robot) const {
  const auto start = std::chrono::steady_clock::now();
  for (robot.update(world); robot.isAheadOfTf(max_latency_) && secondsSince(start) < max_latency_;
       robot.update(world)) {
    checkCancelled();
    std::this_thread::sleep_for(kTfPeriod);
  }
}

std::string LiveMap::frameOf(const octomap_msgs::Octomap& message) const {
  const std::string frame = withoutLeadingSlash(message.header.frame_id);
  return frame.empty() ? history_.fixedFrame() : frame;
}

/// Begins a map with another frame or resolution than the last one.
void LiveMap::begin(const std::string& frame, double resolution, const VoxelMapOptions& options) {
  map_ = std::make_unique<VoxelMap>(kLiveMap, frame, options);
  frame_ = frame;
  resolution_ = resolution;
  tiles_.clear();
  markOutdated();
  constexpr double kCorner = 0.37;  // √3/2 − 1/2, rounded up: how much farther a voxel's corner is than its sides
  if (options.padding < kCorner * resolution)
    ROS_WARN("Map: voxels of %s m that the robot touches may count as obstacles: octomap/padding should be %s m",
             numberText(resolution).c_str(), numberText(kCorner * resolution).c_str());
}

void LiveMap::markOutdated() {
  if (in_scene_ == InScene::kTiles) in_scene_ = InScene::kOther;
}

/// The voxels that the robot fills, according to tf.
std::vector<VoxelMask> LiveMap::masksOf(const CheckedWorld& world, RobotInMap& robot) const {
  waitForTf(world, robot);
  if (!robot.problem().empty()) {
    ROS_WARN_THROTTLE(10.0, "Voxels of the robot itself in a map count as obstacles where its pose is not known: %s",
                      robot.problem().c_str());
  }
  RobotMasks found = robotMasks(world.scene(), world.description(), robot.bodies());
  if (!found.without_field.empty())
    ROS_WARN_ONCE("Voxels that %s fills count, as it has no field", found.without_field.c_str());
  return std::move(found.masks);
}

/// A clock that went back, a reset, or a frame that moved: nothing is known any more of what was there before.
void LiveMap::forgetIfMoved(const std::string& frame, const RobotInMap& robot, const ros::Time& stamp) {
  const double limit = options_.padding + 0.5 * resolution_;
  const bool has_moved = frame_watch_.hasMoved(frame, stamp, robot.bodies(), limit);
  if (has_moved)
    ROS_WARN(
        "Map: its frame %s has moved by more than %s m where the robot is: what the robot touches there is taken "
        "for its own voxels, as in the first map",
        frame.c_str(), numberText(limit).c_str());
  const std::string blind = "the frame " + frame + " of the map on " + parameters_.topic +
                            " moves: where that brings an obstacle within octomap/padding of the robot, it is ignored "
                            "as the robot's own voxels. Publish the map in a frame that does not move";
  warnings_.set("map frame", frame_watch_.isCarried() ? blind : "");
  const bool is_time_back = ros::Time::now() < received_;
  if (forgets_.exchange(false) || has_moved || is_time_back) map_->forget();
}

/// Makes a change of the map part of the scene. @param age  of the tiles then. @return whether there was one.
bool LiveMap::apply(VoxelMap::Change& change, const std::shared_ptr<MapAge>& age) {
  for (const std::string& name : change.removed) tiles_.erase(name);
  for (BodyDescription& tile : change.made) tiles_[tile.name] = std::move(tile);
  if (change.made.empty() && change.removed.empty() && in_scene_ == InScene::kTiles) return false;
  markOutdated();  // if setMap() fails, the next map tries again
  std::vector<BodyDescription> tiles;
  tiles.reserve(tiles_.size());
  for (const auto& [name, tile] : tiles_) tiles.push_back(tile);
  editor_.setMap(std::move(tiles), change.objects, age, arena_);
  age_ = age;
  in_scene_ = InScene::kTiles;
  return true;
}

void LiveMap::process(const octomap_msgs::Octomap& message, const ros::Time& received, RobotInMap& robot,
                      bool is_again) {
  const auto start = std::chrono::steady_clock::now();
  if (message.data.size() > kMaxBytes) throw std::runtime_error("it is larger than 256 MiB");
  const std::string frame = frameOf(message);
  if (frame.size() > RequestLimits().name || frame != shownText(frame))
    throw std::runtime_error("its frame has no valid name");
  VoxelMapOptions options = options_;
  options.band += 1.1 * kHalfSqrt3 * 0.5 * message.resolution;
  VoxelGrid grid(message.resolution, options);
  if (map_ && frame == frame_) map_->watch(grid);
  grid.addOctree(message.data.data(), message.data.size(), message.id, message.binary != 0);
  const std::shared_ptr<const CheckedWorld> world = editor_.world();
  VoxelMap::Surroundings around;
  around.masks = masksOf(*world, robot);
  around.is_robot_known = robot.isSomewhere();
  around.is_again = is_again;
  const double read = secondsSince(start);
  if (!map_ || frame != frame_ || message.resolution != resolution_) begin(frame, message.resolution, options);
  const ros::Time stamp(message.header.stamp.sec, message.header.stamp.nsec);
  if (!is_again) forgetIfMoved(frame, robot, stamp);
  around.objects = ObjectsInMap(history_, *world, frame).masks(stamp, [&](const auto& name, std::uint64_t declared) {
    return map_->isNew(name, declared);
  });
  VoxelMap::Change change;
  arena_.run([&] { change = map_->update(grid, around); });
  judged_version_ = world->version();
  const double built = secondsSince(start);
  const std::size_t made = change.made.size();
  std::shared_ptr<MapAge> age;
  if (parameters_.max_age > 0.0)
    age = std::make_shared<MapAge>(parameters_.topic, parameters_.max_age, sinceEpoch(received));
  if (!apply(change, age) && age_) age_->set(sinceEpoch(received));
  unknown_ = robot.unknown();
  unproven_ = change.unproven;
  const std::string ignored =
      "voxels of the map that touch the robot are ignored as its own, though they were there when they were first "
      "seen: obstacles may be among them (map_voxels_unproven)";
  warnings_.set("map voxels ignored", change.unproven > 0 ? ignored : "");
  const bool keeps_all = change.unseen > 0 && !grid.hasFree();
  const std::string kept = "the map on " + parameters_.topic +
                           " shows no free space, so what was occupied in it stays an obstacle until the service reset";
  warnings_.set("map without free space", keeps_all ? kept : "");
  if (change.forgotten > 0)
    ROS_WARN_THROTTLE(10.0, "Map: %zu voxels that the maps no longer know are forgotten, as they are too many",
                      change.forgotten);
  ROS_INFO_THROTTLE(
      10.0,
      "Map: %zu voxels in %zu tiles, %zu of them new, %zu voxels are the robot's, %zu are judged as objects; scene "
      "version %lu after %.1f ms (reading %.1f, tiles %.1f)",
      change.occupied, tiles_.size(), made, change.masked, change.in_objects,
      static_cast<unsigned long>(editor_.world()->version()), 1e3 * secondsSince(start), 1e3 * read,
      1e3 * (built - read));
}

}  // namespace sdf_ccd
