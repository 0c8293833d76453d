#include "ros/live_map.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <ros/console.h>

#include "common/shown_text.h"
#include "field/uniform/sparse_grid.h"
#include "ros/low_priority.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

constexpr const char* kName = "octomap";
constexpr std::size_t kMostBytes = std::size_t{256} << 20;
const ros::WallDuration kPatience(0.1);  // until tf has the map's stamp

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A body's parts, each with the pose of the map's frame in its own.
struct MaskSolid {
  Isometry3d X_GM;
  const Primitive* primitive;  // null: the field
  const DistanceField* field;

  double distance(const Vector3d& p_M) const {
    if (primitive) return signedDistance(*primitive, X_GM * p_M);
    const FieldSample known = field->sample(X_GM * p_M);
    return known.value - known.error;
  }
};

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
      [this](const octomap_msgs::Octomap::ConstPtr& message) { this->hear(*message); };
  subscriber_ = own.subscribe<octomap_msgs::Octomap>(parameters_.topic, 1, hear);
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
}

LiveMap::~LiveMap() {
  queue_.disable();
  spinner_->stop();
}

void LiveMap::hear(const octomap_msgs::Octomap& message) {
  lowerPriority();
  const CancelScope scope(stop_);
  try {
    take(message);
  } catch (const Cancelled&) {
    // The monitor ends.
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(5.0, "A map is not taken, and the last one stays: %s", error.what());
  }
}

void LiveMap::take(const octomap_msgs::Octomap& message) {
  const auto start = std::chrono::steady_clock::now();
  if (message.data.size() > kMostBytes) throw std::runtime_error("it is larger than 256 MiB");
  std::string frame = withoutLeadingSlash(message.header.frame_id);
  if (frame.empty()) frame = history_.fixedFrame();
  if (frame.size() > RequestLimits().name || frame != shownText(frame)) throw std::runtime_error("its frame is none");
  VoxelMapOptions options = options_;
  options.band += 1.1 * kHalfSqrt3 * 0.5 * message.resolution;
  VoxelGrid grid(message.resolution, options);
  grid.addOctree(message.data.data(), message.data.size(), message.id, message.binary != 0);
  const std::shared_ptr<const CheckedWorld> world = editor_.world();
  const std::vector<VoxelMask> masks = masksOf(*world, frame, message.header.stamp);
  const double read = secondsSince(start);
  if (!map_ || frame != frame_) {
    map_ = std::make_unique<VoxelMap>(kName, frame, options);
    frame_ = frame;
    tiles_.clear();
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
  const std::uint64_t version = made > 0 || !change.removed.empty() ? editor_.setMap(std::move(tiles), fields) : world->version();
  ROS_INFO_THROTTLE(10.0,
                    "Map: %zu voxels in %zu tiles, %zu of them new, %zu voxels are the robot's; scene version %lu after "
                    "%.1f ms (reading %.1f, tiles %.1f)",
                    change.occupied, tiles_.size(), made, change.masked, static_cast<unsigned long>(version),
                    1e3 * secondsSince(start), 1e3 * read, 1e3 * (built - read));
}

std::vector<VoxelMask> LiveMap::masksOf(const CheckedWorld& world, const std::string& frame,
                                        const ros::Time& stamp) const {
  Isometry3d X_WM;
  std::string problem;
  ros::Time when = stamp;
  const ros::WallTime end = ros::WallTime::now() + kPatience;
  while (!history_.lookup(frame, when, X_WM, problem) && ros::WallTime::now() < end) {
    checkCancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::vector<Isometry3d> X_WB;
  std::vector<std::string> missing;
  const auto isLost = [&](std::size_t b) { return !world.scene().bodies[b].is_world && !missing[b].empty(); };
  const auto anyLost = [&] {
    for (std::size_t b = 0; b < missing.size(); ++b)
      if (isLost(b)) return true;
    return false;
  };
  std::vector<TrackedBody> robot;
  std::vector<std::size_t> places;
  for (std::size_t b = 0; b < world.bodies.size(); ++b) {
    if (world.scene().bodies[b].is_world) continue;
    robot.push_back(world.bodies[b]);
    places.push_back(b);
  }
  const auto look = [&](const ros::Time& time) {
    std::vector<Isometry3d> poses;
    std::vector<std::string> lost;
    posesAt(history_, robot, time, poses, lost);
    X_WB.assign(world.bodies.size(), Isometry3d::Identity());
    missing.assign(world.bodies.size(), "");
    for (std::size_t i = 0; i < places.size(); ++i) {
      X_WB[places[i]] = poses[i];
      missing[places[i]] = lost[i];
    }
  };
  look(when);
  while (anyLost() && ros::WallTime::now() < end) {
    checkCancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    look(when);
  }
  if (anyLost()) look(ros::Time());
  if (!history_.lookup(frame, when, X_WM, problem) && !history_.lookup(frame, ros::Time(), X_WM, problem)) {
    ROS_WARN_THROTTLE(10.0, "The robot's own voxels in a map are not known: %s", problem.c_str());
    return {};
  }
  std::vector<VoxelMask> masks;
  for (const std::size_t b : places) {
    const Body& body = world.scene().bodies[b];
    if (isLost(b) || !body.failure.empty()) continue;
    const BodyDescription& description = world.description().bodies[b];
    const bool has_fields = body.parts.size() == description.geometry.size();
    const Isometry3d X_BM = X_WB[b].inverse() * X_WM;
    std::vector<MaskSolid> parts;
    AlignedBox3d box;
    for (std::size_t i = 0; i < description.geometry.size(); ++i) {
      const GeometryDescription& geometry = description.geometry[i];
      const auto* primitive = std::get_if<Primitive>(&geometry.shape);
      if (!primitive && !has_fields) continue;
      const AlignedBox3d part = primitive ? boundingBox(*primitive) : body.parts[i].field.surfaceBox();
      if (!part.sizes().allFinite()) continue;
      for (int k = 0; k < 8; ++k) box.extend(geometry.X_BG * part.corner(AlignedBox3d::CornerType(k)));
      parts.push_back({geometry.X_BG.inverse() * X_BM, primitive, primitive ? nullptr : &body.parts[i].field});
    }
    if (parts.empty()) {
      if (!description.geometry.empty())
        ROS_WARN_ONCE("Voxels that %s fills count, as it has no field: no other link is checked against it",
                      body.name.c_str());
      continue;
    }
    VoxelMask mask;
    mask.center_M = X_BM.inverse() * box.center();
    mask.radius = 0.5 * box.diagonal().norm();
    mask.distance = [parts](const Vector3d& p_M) {
      double least = parts.front().distance(p_M);
      for (const MaskSolid& solid : parts) least = std::min(least, solid.distance(p_M));
      return least;
    };
    masks.push_back(std::move(mask));
  }
  return masks;
}

}  // namespace sdf_ccd
