#include "ros/monitor/marker_outputs.h"

#include <ros/console.h>
#include <visualization_msgs/MarkerArray.h>

#include "monitor/scene_difference.h"
#include "ros/messages/shape_marker.h"
#include "ros/messages/world_markers.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kDrawings = 2;  // one is drawn, and one may wait
const ros::WallDuration kWorldPeriod(1.0);

}  // namespace

MarkerOutputs::MarkerOutputs(ros::NodeHandle private_node, const ros::Publisher& world, const MonitorLoop& loop,
                             const MarkerOptions& options)
    : loop_(loop), world_publisher_(world), options_(options), drawer_(loop.fixedFrame(), options) {
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>("markers", 10);
  links_ = private_node.advertise<visualization_msgs::MarkerArray>("links", 10, true);
  setDrawnWorld(loop.world());
  worker_ = std::make_unique<OrderedWorker<Drawing>>(kDrawings, [this](Drawing& drawing) { send(drawing); });
}

MarkerOutputs::~MarkerOutputs() = default;

void MarkerOutputs::countSubscribers() {
  wants_markers_ = markers_.getNumSubscribers() > 0;
  wants_links_ = links_.getNumSubscribers() > 0;
  wants_world_ = world_publisher_.getNumSubscribers() > 0;
}

void MarkerOutputs::draw() {
  Drawing* const drawing = next(wants_markers_ || wants_links_);
  if (!drawing) return;
  if (drawing->has_cycle) drawing->snapshot.copyFrom(loop_);
  worker_->handOver();
}

void MarkerOutputs::drawUnchecked(const std::string& reason) {
  is_unchecked_ = true;
  reason_ = reason;
  if (next(false)) worker_->handOver();
}

/// A drawing to hand over; null if nothing is to be drawn, or others wait: then a later one draws it.
MarkerOutputs::Drawing* MarkerOutputs::next(bool has_cycle) {
  const bool is_world_due = isWorldDue();
  if (!has_cycle && !is_world_due && !is_unchecked_) return nullptr;
  Drawing* const drawing = worker_->tryNext();
  if (!drawing) return nullptr;
  drawing->is_unchecked = is_unchecked_;
  drawing->reason = reason_;
  drawing->options = options_;
  drawing->has_cycle = has_cycle;
  drawing->draws_markers = wants_markers_;
  drawing->draws_links = wants_links_;
  drawing->draws_world = is_world_due;
  drawing->world = loop_.world();
  is_unchecked_ = false;
  if (is_world_due) {
    world_drawn_ = loop_.world()->version();
    world_drawn_at_ = ros::WallTime::now();
  }
  return drawing;
}

/// Drawing large worlds takes a while, so it waits for a subscriber.
bool MarkerOutputs::isWorldDue() const {
  if (!wants_world_ || loop_.world()->version() == world_drawn_) return false;
  return world_drawn_ == 0 || ros::WallTime::now() - world_drawn_at_ > kWorldPeriod;
}

void MarkerOutputs::finish() {
  is_finishing_ = true;
  if (is_unchecked_) {  // others waited; their cycles are not drawn any more, so that there is room again
    worker_->next();
    if (next(false)) worker_->handOver();
  }
  worker_.reset();
}

void MarkerOutputs::send(Drawing& drawing) {
  try {
    draw(drawing);
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(1.0, "A cycle could not be drawn: %s", error.what());
  }
  drawing.world.reset();
  drawing.snapshot.release();
}

void MarkerOutputs::draw(const Drawing& drawing) {
  setDrawnWorld(drawing.world);
  if (drawing.draws_world) drawWorld(*drawing.world);
  if (drawing.is_unchecked)
    markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(drawer_.clear(drawing.reason)));
  const bool draws_cycle = drawing.has_cycle && !is_finishing_;
  if (draws_cycle) {
    drawer_.setOptions(drawing.options);
    const auto markers = boost::make_shared<visualization_msgs::MarkerArray>(drawer_.draw(
        drawing.snapshot.result(), drawing.snapshot.context(), ros::Time::now(), drawing.snapshot.warnings()));
    if (drawing.draws_markers) markers_.publish(markers);
  }
  if (drawing.draws_links && (draws_cycle || drawing.is_unchecked)) drawLinks();
}

/// Called by the drawing thread.
void MarkerOutputs::setDrawnWorld(const std::shared_ptr<const CheckedWorld>& world) {
  if (world == drawn_) return;
  if (drawn_) drawer_.switchPairs(findPairs(pairNames(world->scene()), pairNames(drawn_->scene())));
  link_markers_ = std::make_unique<LinkMarkers>(world->description());
  drawn_ = world;
}

void MarkerOutputs::drawWorld(const CheckedWorld& world) {
  const auto markers = boost::make_shared<visualization_msgs::MarkerArray>(toWorldMarkers(world.description()));
  if (has_drawn_world_)  // deletes objects that no longer exist
    markers->markers.insert(markers->markers.begin(), deleteAllMarker(loop_.fixedFrame()));
  has_drawn_world_ = true;
  world_publisher_.publish(markers);
}

void MarkerOutputs::drawLinks() {
  constexpr double kAgain = 2.0;  // rviz drops markers for good whose frames it does not know yet [s]
  const ros::WallTime now = ros::WallTime::now();
  const bool has_changed = link_markers_->draw(drawer_.states().ofBodies(drawn_->scene()));
  if (!has_changed && (now - links_drawn_at_).toSec() < kAgain) return;
  links_drawn_at_ = now;
  links_.publish(boost::make_shared<visualization_msgs::MarkerArray>(link_markers_->markers()));
}

}  // namespace sdf_ccd
