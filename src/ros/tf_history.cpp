#include "ros/tf_history.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <tf2/exceptions.h>

#include "ros/conversions.h"

namespace sdf_ccd {
namespace {

const ros::Duration kKeep(10.0);        // as long as the buffer keeps transforms
const ros::Duration kJumpBack(1.0);     // publishers may disagree, and a wall clock be set back, by less
const ros::Duration kSimJumpBack(0.1);  // two threads may see a simulated clock this much apart

bool equal(const geometry_msgs::Transform& a, const geometry_msgs::Transform& b) {
  return a.translation.x == b.translation.x && a.translation.y == b.translation.y &&
         a.translation.z == b.translation.z && a.rotation.x == b.rotation.x && a.rotation.y == b.rotation.y &&
         a.rotation.z == b.rotation.z && a.rotation.w == b.rotation.w;
}

}  // namespace

std::string withoutLeadingSlash(const std::string& frame) {
  const std::size_t start = frame.find_first_not_of('/');
  return start == std::string::npos ? std::string() : frame.substr(start);
}

TfHistory::TfHistory(const std::string& fixed_frame) : fixed_frame_(withoutLeadingSlash(fixed_frame)), buffer_(kKeep) {}

void TfHistory::watchClock(const ros::Time& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (now + (ros::Time::isSimTime() ? kSimJumpBack : kJumpBack) < clock_) clear();
  clock_ = now;
}

void TfHistory::add(const tf2_msgs::TFMessage& message, bool is_static) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const geometry_msgs::TransformStamped& transform : message.transforms) addOne(transform, is_static);
}

void TfHistory::addOne(const geometry_msgs::TransformStamped& transform, bool is_static) {
  const std::string child = withoutLeadingSlash(transform.child_frame_id);
  const auto known = edges_.find(child);
  if (!is_static && known != edges_.end() && !known->second.records.empty()) {
    const std::deque<Record>& records = known->second.records;
    if (transform.header.stamp + kJumpBack < records.back().stamp) {
      clear();
    } else if (std::any_of(records.rbegin(), records.rend(),
                           [&](const Record& r) { return r.stamp == transform.header.stamp; })) {
      return;  // tf2 ignores a repeated time too, but with a warning each
    }
  }
  if (!buffer_.setTransform(transform, "sdf_ccd", is_static)) return;  // tf2 has said why
  Edge& edge = edges_[child];
  const std::string parent = withoutLeadingSlash(transform.header.frame_id);
  if (edge.parent != parent || edge.is_static != is_static) edge = Edge{parent, is_static, {}, {}};
  if (!is_static) record(edge, transform);
}

void TfHistory::record(Edge& edge, const geometry_msgs::TransformStamped& transform) {
  const ros::Time stamp = transform.header.stamp;
  std::deque<Record>& records = edge.records;
  if (records.empty() || stamp > records.back().stamp) {
    records.push_back({stamp, records.empty() || !equal(edge.newest, transform.transform)});
    edge.newest = transform.transform;
    while (stamp > records.front().stamp + kKeep) records.pop_front();
  } else {
    ++out_of_order_;
    const auto next = std::upper_bound(records.begin(), records.end(), stamp,
                                       [](const ros::Time& t, const Record& r) { return t < r.stamp; });
    next->differs = true;
    records.insert(next, {stamp, true});
  }
}

void TfHistory::clear() {
  buffer_.clear();  // keeps static transforms
  for (auto edge = edges_.begin(); edge != edges_.end();) {
    edge = edge->second.is_static ? std::next(edge) : edges_.erase(edge);
  }
  jumped_ = true;
}

bool TfHistory::takeJump() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(jumped_, false);
}

long TfHistory::outOfOrder() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return out_of_order_;
}

std::vector<const TfHistory::Edge*> TfHistory::edgesUpwards(const std::string& frame) const {
  std::vector<const Edge*> edges;
  auto edge = edges_.find(frame);
  while (edge != edges_.end() && edges.size() < edges_.size()) {  // a loop would be longer
    edges.push_back(&edge->second);
    edge = edges_.find(edge->second.parent);
  }
  return edges;
}

std::vector<std::string> TfHistory::framesAbove(const std::string& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> above;
  for (const Edge* edge : edgesUpwards(frame)) above.push_back(edge->parent);
  return above;
}

std::string TfHistory::rootOf(const std::string& frame) const {
  const std::vector<const Edge*> edges = edgesUpwards(frame);
  return edges.empty() ? frame : edges.back()->parent;
}

bool TfHistory::chain(const std::string& frame, std::vector<const Edge*>& edges, std::string& problem) const {
  edges = edgesUpwards(frame);
  std::vector<const Edge*> fixed = edgesUpwards(fixed_frame_);
  if (rootOf(frame) != rootOf(fixed_frame_)) {
    problem = "no transform from " + frame + " to " + fixed_frame_;
    return false;
  }
  while (!edges.empty() && !fixed.empty() && edges.back() == fixed.back()) {
    edges.pop_back();
    fixed.pop_back();
  }
  edges.insert(edges.end(), fixed.begin(), fixed.end());
  return true;
}

TfHistory::Span TfHistory::span(const std::string& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return lockedSpan(frame);
}

std::vector<TfHistory::Span> TfHistory::spans(const std::vector<std::string>& frames) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Span> spans;
  for (const std::string& frame : frames) spans.push_back(lockedSpan(frame));
  return spans;
}

TfHistory::Span TfHistory::lockedSpan(const std::string& frame) const {
  Span span;
  std::vector<const Edge*> edges;
  if (!chain(frame, edges, span.problem)) return span;
  span.is_static = true;
  for (const Edge* edge : edges) {
    if (edge->is_static) continue;
    const ros::Time first = edge->records.front().stamp;
    const ros::Time last = edge->records.back().stamp;
    span.first = span.is_static ? first : std::max(span.first, first);
    span.last = span.is_static ? last : std::min(span.last, last);
    span.is_static = false;
  }
  return span;
}

void TfHistory::recordedTimes(const std::string& frame, const ros::Time& start, const ros::Time& end,
                              std::vector<ros::Time>& times) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<const Edge*> edges;
  std::string problem;
  if (!chain(frame, edges, problem)) return;
  for (const Edge* edge : edges) {
    const std::deque<Record>& records = edge->records;
    for (std::size_t i = records.size(); i-- > 0 && records[i].stamp > start;) {
      const bool moves = records[i].differs || (i + 1 < records.size() && records[i + 1].differs);
      if (moves && records[i].stamp < end) times.push_back(records[i].stamp);
    }
  }
}

double TfHistory::longestGap(const std::string& frame, const ros::Time& start, const ros::Time& end) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<const Edge*> edges;
  std::string problem;
  if (!chain(frame, edges, problem)) return std::numeric_limits<double>::infinity();
  double longest = 0.0;
  for (const Edge* edge : edges) {
    const std::deque<Record>& records = edge->records;
    for (std::size_t i = records.size(); i-- > 1 && records[i].stamp > start;) {
      if (records[i - 1].stamp < end) longest = std::max(longest, (records[i].stamp - records[i - 1].stamp).toSec());
    }
  }
  return longest;
}

bool TfHistory::lookup(const std::string& frame, const ros::Time& time, Isometry3d& X_WF, std::string& problem) const {
  return lookup(fixed_frame_, frame, time, X_WF, problem);
}

bool TfHistory::lookup(const std::string& target, const std::string& frame, const ros::Time& time, Isometry3d& X_TF,
                       std::string& problem) const {
  if (target == frame) {  // also for a frame that tf2 has not heard of
    X_TF.setIdentity();
    return true;
  }
  try {
    X_TF = toIsometry(buffer_.lookupTransform(target, frame, time).transform);
    return true;
  } catch (const tf2::TransformException& error) {
    problem = error.what();
    return false;
  }
}

}  // namespace sdf_ccd
