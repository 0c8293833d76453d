#include "ros/messages/markers.h"

#include <algorithm>

#include "common/number_text.h"
#include "motion/screw_motion.h"
#include "ros/messages/shape_marker.h"
#include "ros/messages/status_text.h"
#include "ros/tf/seconds_between.h"
#include "scene/name_pair.h"

namespace sdf_ccd {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr const char* kStatus = "status";
constexpr const char* kPoints = "points";
constexpr const char* kNormals = "normals";
constexpr const char* kDepth = "depth";
constexpr const char* kSwept = "swept";
constexpr const char* kNumbers = "numbers";

constexpr double kLetter = 1.0 / 26.0;  // relative to the robot's size
constexpr double kLineSpacing = 1.25;   // relative to a letter's height
constexpr double kNumberOffset = 2.0;   // above the contact, in letters

// Magenta for contacts that a check at the recorded transforms would have missed, white for the others: both differ
// from the colours of the links, whatever their verdicts.
std_msgs::ColorRGBA contactColor(bool seen_at_samples) {
  return seen_at_samples ? toColor(1.0F, 1.0F, 1.0F, 1.0F) : toColor(1.0F, 0.15F, 0.85F, 1.0F);
}

/// Positions of a point of the body at every time of the span: the point that is at p_W when the contact is deepest.
std::vector<Vector3d> pathOf(int body, const ContactPoint& point, const CycleMotion& motion, const WaypointSpan& span) {
  std::size_t next = span.first + 1;
  while (next < span.last && motion.times[next] < point.time) ++next;
  const double length = motion.times[next] - motion.times[next - 1];
  const ScrewMotion screw(motion.pose(body, next - 1), motion.pose(body, next));
  const Vector3d p_B = screw.pose((point.time - motion.times[next - 1]) / length).inverse() * point.p_W;
  std::vector<Vector3d> path;
  for (std::size_t k = span.first; k <= span.last; ++k) path.push_back(motion.pose(body, k) * p_B);
  return path;
}

void addPath(const std::vector<Vector3d>& path, Marker& lines) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    lines.points.push_back(toPoint(path[i]));
    lines.points.push_back(toPoint(path[i + 1]));
  }
}

}  // namespace

std::vector<Vector3d> staggered(std::vector<Vector3d> positions, double height) {
  std::vector<Vector3d*> by_height;
  for (Vector3d& position : positions) by_height.push_back(&position);
  std::stable_sort(by_height.begin(), by_height.end(), [](auto* a, auto* b) { return a->z() < b->z(); });
  for (std::size_t i = 1; i < by_height.size(); ++i) {
    by_height[i]->z() = std::max(by_height[i]->z(), by_height[i - 1]->z() + height);
  }
  return positions;
}

Marker MarkerDrawer::marker(const char* name, int id, int type) const {
  return makeMarker(fixed_frame_, name, id, type);
}

/// The height of a letter [m].
double MarkerDrawer::letter() const {
  return kLetter * options_.scale * box_.size();
}

MarkerArray MarkerDrawer::draw(const CycleResult& result, const CycleContext& cycle, const ros::Time& now,
                               const std::vector<std::string>& warnings) {
  MarkerArray markers;
  if (deletes_all_) {
    markers.markers.push_back(deleteAllMarker(fixed_frame_));
    deletes_all_ = false;
  }
  states_.update(result, cycle);
  box_.update(result, cycle);
  const ros::Time end = cycle.start + ros::Duration(cycle.motion.times.back());
  for (std::size_t id = 0; id < result.pairs.size(); ++id) {
    const PairResult& pair = result.pairs[id];
    if (!pair.intervals.empty()) drawPair(static_cast<int>(id), pair, cycle, markers);
  }
  deleteOld(end, markers);
  const std::vector<const Shown*> listed = deepest();
  drawNumbers(listed, markers);

  ros::Time known_until = end;
  for (const PairState& pair : states_.pairs()) {
    if (pair.verdict != Verdict::kNotChecked) known_until = std::min(known_until, pair.until);
  }
  std::string text = statusText(states_, result, cycle, secondsBetween(known_until, now), warnings);
  for (std::size_t i = 0; i < listed.size(); ++i) text += "\n" + std::to_string(i + 1) + "  " + listed[i]->text;
  if (shown_.size() > listed.size()) text += "\nand " + std::to_string(shown_.size() - listed.size()) + " more";
  markers.markers.push_back(statusMarker(text, states_.verdict()));
  return markers;
}

void MarkerDrawer::switchPairs(const std::vector<int>& before) {
  states_.switchPairs(before);
  deletes_all_ |= !shown_.empty();
  shown_.clear();
  numbers_ = 0;
}

MarkerArray MarkerDrawer::clear(const std::string& reason) {
  shown_.clear();
  numbers_ = 0;
  states_.clear();
  MarkerArray markers;
  markers.markers.push_back(deleteAllMarker(fixed_frame_));
  markers.markers.push_back(statusMarker(uncheckedText(reason), Verdict::kNotChecked));
  return markers;
}

void MarkerDrawer::deleteOld(const ros::Time& end, MarkerArray& markers) {
  for (auto shown = shown_.begin(); shown != shown_.end();) {
    if (shown->second.until > end) {
      ++shown;
      continue;
    }
    for (const char* name : {kPoints, kNormals, kDepth, kSwept}) {
      markers.markers.push_back(marker(name, shown->first, Marker::SPHERE));
      markers.markers.back().action = Marker::DELETE;
    }
    shown = shown_.erase(shown);
  }
}

std::vector<const MarkerDrawer::Shown*> MarkerDrawer::deepest() const {
  std::vector<const Shown*> listed;
  for (const auto& [id, shown] : shown_) listed.push_back(&shown);
  std::stable_sort(listed.begin(), listed.end(), [](auto* a, auto* b) { return a->depth > b->depth; });
  if (listed.size() > kListed) listed.resize(kListed);
  return listed;
}

void MarkerDrawer::drawNumbers(const std::vector<const Shown*>& listed, MarkerArray& markers) {
  std::vector<Vector3d> positions;
  for (const Shown* shown : listed) positions.push_back(shown->p_W + kNumberOffset * letter() * Vector3d::UnitZ());
  positions = staggered(std::move(positions), kLineSpacing * letter());
  for (int i = 0; i < std::max(numbers_, static_cast<int>(positions.size())); ++i) {
    Marker number = marker(kNumbers, i, Marker::TEXT_VIEW_FACING);
    if (i < static_cast<int>(positions.size())) {
      number.text = std::to_string(i + 1);
      number.pose.position = toPoint(positions[i]);
      number.scale.z = letter();
      number.color = toColor(1.0F, 1.0F, 1.0F, 1.0F);
    } else {
      number.action = Marker::DELETE;
    }
    markers.markers.push_back(number);
  }
  numbers_ = static_cast<int>(positions.size());
}

/// The lowest line is above the robot; rviz centres a text at its position.
Marker MarkerDrawer::statusMarker(const std::string& text, Verdict verdict) const {
  Marker status = marker(kStatus, 0, Marker::TEXT_VIEW_FACING);
  status.text = text;
  status.scale.z = letter();
  status.color = verdictColor(verdict, 1.0F);
  const double above = (0.5 * lineCount(text) + 2.5) * kLineSpacing * letter();
  status.pose.position = toPoint(box_.top() + above * Vector3d::UnitZ());
  return status;
}

void MarkerDrawer::drawPair(int id, const PairResult& pair, const CycleContext& cycle, MarkerArray& markers) {
  const double unit = options_.scale * box_.size();
  const bool seen = touchesAtSamples(pair, cycle);
  Marker points = marker(kPoints, id, Marker::SPHERE_LIST);
  Marker normals = marker(kNormals, id, Marker::LINE_LIST);
  Marker depth = marker(kDepth, id, Marker::ARROW);
  Marker swept = marker(kSwept, id, Marker::LINE_LIST);
  points.scale.x = points.scale.y = points.scale.z = unit / 130.0;
  normals.scale.x = unit / 1000.0;
  depth.scale.x = unit / 220.0;
  depth.scale.y = unit / 90.0;
  swept.scale.x = unit / 500.0;
  points.color = depth.color = contactColor(seen);
  normals.color = toColor(1.0F, 1.0F, 1.0F, 0.9F);
  swept.color = toColor(0.0F, 0.75F, 0.55F, 0.9F);

  for (const ContactPoint& point : pair.points) {
    points.points.push_back(toPoint(point.p_W));
    normals.points.push_back(toPoint(point.p_W));
    normals.points.push_back(toPoint(point.p_W + unit / 60.0 * point.normal_W));
    for (const int body : {pair.body_a, pair.body_b}) {
      if (!cycle.scene.bodies[body].is_world) addPath(pathOf(body, point, cycle.motion, pair.span), swept);
    }
  }
  // From the deepest point outwards to where it would be free, and farther, so that it is visible.
  depth.points.push_back(toPoint(pair.deepest.p_W));
  depth.points.push_back(toPoint(pair.deepest.p_W - (pair.deepest.depth + unit / 25.0) * pair.deepest.normal_W));
  if (!points.points.empty()) {
    for (Marker* filled : {&points, &normals, &swept}) markers.markers.push_back(std::move(*filled));
  }
  markers.markers.push_back(depth);

  const double deepest = std::max(states_.pairs()[id].depth, pair.deepest.depth);  // while it is shown
  const std::string text = pairName(cycle.scene, pair) + ": " + lengthText(deepest) + (seen ? "" : ", between samples");
  const ros::Time end = cycle.start + ros::Duration(cycle.motion.times.back());
  shown_[id] = {end + ros::Duration(options_.hold), pair.deepest.p_W, text, deepest};
}

}  // namespace sdf_ccd
