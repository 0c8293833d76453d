#include "ros/tf_history.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace sdf_ccd {
namespace {

const ros::Duration kJumpBack(1.0);     // publishers may disagree, and a wall clock be set back, by less
const ros::Duration kSimJumpBack(0.1);  // two threads may see a simulated clock this much apart
constexpr std::size_t kGoesOn = 2;  // so many transforms far behind the newest, one after the other, are no late ones
constexpr std::uint32_t kLastSecond = 1u << 31;      // differences of later stamps are no ros::Duration
constexpr std::size_t kLongestName = 256;            // of a frame
constexpr std::size_t kMostOthers[] = {1000, 5000};  // frames that are not followed: moving, static
constexpr std::size_t kMostOtherRecords = 200;       // of one of them
constexpr double kMostRecords = 1e6;                 // of all frames that are followed
constexpr double kFewestRecords = 1000.0;            // of one of them, however many there are
constexpr double kRecordsPerSecond = 2000.0;         // of one of them, if there are few
constexpr std::ptrdiff_t kMostBehind = 1000;         // records that one that comes late may lie behind
const ros::Duration kSweepPeriod(1.0);

ros::Time before(const ros::Time& time, const ros::Duration& duration) {
  return time.toNSec() > static_cast<std::uint64_t>(duration.toNSec()) ? time - duration : ros::Time();
}

bool isEarlier(const TfPose& a, const TfPose& b) {
  return a.stamp < b.stamp;
}

/// The last record that is not after the time; the first if all are.
std::deque<TfPose>::const_iterator lastUpTo(const std::deque<TfPose>& records, const ros::Time& time) {
  TfPose pose;
  pose.stamp = time;
  const auto next = std::upper_bound(records.begin(), records.end(), pose, isEarlier);
  return next == records.begin() ? next : std::prev(next);
}

std::string secondsText(const ros::Time& time) {
  return fmt::format("{:.3f} s", time.toSec());
}

}  // namespace

std::string withoutLeadingSlash(const std::string& frame) {
  const std::size_t start = frame.find_first_not_of('/');
  return start == std::string::npos ? std::string() : frame.substr(start);
}

TfHistory::TfHistory(const std::string& fixed_frame, const TfHistoryOptions& options)
    : fixed_frame_(withoutLeadingSlash(fixed_frame)), keep_(options.keep), followed_(options.wanted) {}

void TfHistory::watchClock(const ros::Time& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool jumps = now < before(clock_, ros::Time::isSimTime() ? kSimJumpBack : kJumpBack);
  if (jumps) clear();
  clock_ = jumps ? now : std::max(clock_, now);
  if (clock_ < swept_ || before(clock_, kSweepPeriod) > swept_) forgetSilentOthers();
}

void TfHistory::add(const tf2_msgs::TFMessage& message, bool is_static) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    const std::string problem = problemOf(transform, is_static);
    problem.empty() ? addOne(transform, is_static) : refuse(problem);
  }
}

void TfHistory::refuse(const std::string& why) {
  ++refused_;
  refusal_ = why;
}

/// Why a transform says nothing; empty if it does.
std::string TfHistory::problemOf(const geometry_msgs::TransformStamped& transform, bool is_static) const {
  const std::string &child = transform.child_frame_id, &parent = transform.header.frame_id;
  const ros::Time& stamp = transform.header.stamp;
  if (child.size() > kLongestName || parent.size() > kLongestName) {
    return "a frame's name has " + std::to_string(std::max(child.size(), parent.size())) + " characters";
  }
  if (child.find_first_not_of('/') == std::string::npos) return "a frame in " + parent + " has no name";
  if (parent.find_first_not_of('/') == std::string::npos) return "the parent of " + child + " has no name";
  if (withoutLeadingSlash(child) == withoutLeadingSlash(parent)) return child + " is its own parent";
  if (is_static) return {};
  if (stamp.sec < kLastSecond && (clock_.isZero() || stamp < clock_ || before(stamp, keep_) <= clock_)) return {};
  return child + " is stamped " + secondsText(stamp) + ", when it is " + secondsText(clock_);
}

void TfHistory::addOne(const geometry_msgs::TransformStamped& transform, bool is_static) {
  const std::string child = withoutLeadingSlash(transform.child_frame_id);
  const std::string parent = withoutLeadingSlash(transform.header.frame_id);
  const ros::Time& sent = transform.header.stamp;
  const ros::Time stamp = is_static ? ros::Time() : ros::Time(sent.sec, sent.nsec);  // nsec may be above a second
  if (edges_.count(child) == 0 && !followed_.has(child) && others_[is_static] >= kMostOthers[is_static]) {
    ++not_kept_;
    static_dropped_ |= is_static;
    return;
  }
  const TfPose pose = toTfPose(stamp, transform.transform);
  const auto [found, is_new] = edges_.try_emplace(child);
  Edge& edge = found->second;
  edge.heard = clock_;
  const bool is_same_kind = edge.is_static == is_static, is_same_parent = edge.parent == parent;
  if (!is_new && is_same_kind && is_same_parent) {
    if (!is_static) return record(child, edge, pose);
    if (isSamePlace(edge.records.back(), pose)) return;
  } else if (!is_new && is_same_kind && !is_static && stamp < edge.records.front().stamp && !hasGoneBack(edge, pose)) {
    return recordBefore(child, edge, pose, is_same_parent);
  }
  const char* change = is_new          ? "has come"
                       : !is_same_kind ? (is_static ? "has become static" : "is no longer static")
                                       : (is_static ? "has another static transform" : "has another parent");
  ros::Time last = is_new || edge.is_static ? ros::Time() : edge.records.back().stamp;
  if (!clock_.isZero()) last = std::min(last, clock_);  // farther no cycle has gone
  beginAnew(edge, {pose}, change);
  if (is_new) {
    edge.is_followed = followed_.has(child);
    edge.is_static = is_static;
    if (!edge.is_followed) ++others_[is_static];
  }
  edge.dropped_until = last;
  setParent(edge, parent, is_static);
  // Cycles may have gone beyond the stamp already, by what the frame was before.
  if (!is_new && !is_static) noteLate(edge, {child, stamp, ros::TIME_MAX});
}

void TfHistory::setParent(Edge& edge, const std::string& parent, bool is_static) {
  if (!edge.is_followed && edge.is_static != is_static) {
    --others_[edge.is_static];
    ++others_[is_static];
  }
  edge.is_static = is_static;
  edge.parent = parent;
  if (edge.is_followed) followAbove(parent);
}

void TfHistory::followAbove(const std::string& parent) {
  if (followed_.has(parent)) return;
  const auto parent_of = [this](const std::string& frame) {
    const auto edge = edges_.find(frame);
    return edge == edges_.end() ? nullptr : &edge->second.parent;
  };
  if (followed_.addParent(parent, parent_of)) {
    for (auto& [child, edge] : edges_) setFollowed(edge, followed_.has(child));
    return;
  }
  const Way known = edgesUpwards(parent);
  static_missed_ |= static_dropped_ && (known.empty() ? parent : known.back()->second.parent) != fixed_frame_;
  auto above = edges_.find(parent);
  for (; above != edges_.end() && !above->second.is_followed && followed_.has(above->first);
       above = edges_.find(above->second.parent)) {
    setFollowed(above->second, true);
  }
}

void TfHistory::setFollowed(Edge& edge, bool is_followed) {
  if (edge.is_followed == is_followed) return;
  edge.is_followed = is_followed;
  is_followed ? --others_[edge.is_static] : ++others_[edge.is_static];
  if (!edge.is_static) drop(edge);
}

/// Makes room for others, as moving frames are known again as soon as they come again.
void TfHistory::forgetSilentOthers() {
  swept_ = clock_;
  for (auto edge = edges_.begin(); edge != edges_.end();) {
    const Edge& known = edge->second;
    const bool is_silent = !known.is_followed && !known.is_static && known.heard < before(clock_, keep_);
    if (is_silent) --others_[0];
    edge = is_silent ? edges_.erase(edge) : std::next(edge);
  }
}

void TfHistory::beginAnew(Edge& edge, const std::deque<TfPose>& records, const char* change) {
  edge.records = records;
  edge.dropped_until = ros::Time();
  edge.is_cut = false;
  edge.behind.clear();
  edge.version = ++versions_;
  edge.change = change;
}

void TfHistory::record(const std::string& child, Edge& edge, const TfPose& pose) {
  std::deque<TfPose>& records = edge.records;
  if (pose.stamp > records.back().stamp) {
    edge.behind.clear();
    records.push_back(pose);
    drop(edge);
  } else if (hasGoneBack(edge, pose)) {
    beginAnew(edge, std::deque<TfPose>(edge.behind), "has stamps that went back");
  } else if (pose.stamp < records.front().stamp) {
    recordBefore(child, edge, pose, true);
  } else {
    recordBehind(child, edge, pose);
  }
}

/// What is too old, or too much.
void TfHistory::drop(Edge& edge) const {
  const double share = kMostRecords / static_cast<double>(followed_.size() + 1);
  const double most = std::max(kFewestRecords, std::min(share, kRecordsPerSecond * keep_.toSec()));
  const std::size_t kept = edge.is_followed ? static_cast<std::size_t>(most) : kMostOtherRecords;
  std::deque<TfPose>& records = edge.records;
  const ros::Time oldest = before(records.back().stamp, keep_);
  for (; records.front().stamp < oldest || records.size() > kept; records.pop_front()) {
    edge.dropped_until = records.front().stamp;
    edge.is_cut = true;
  }
}

/// Whether the stamps go on far behind the newest.
bool TfHistory::hasGoneBack(Edge& edge, const TfPose& pose) {
  if (pose.stamp >= before(edge.records.back().stamp, kJumpBack)) return false;
  if (!edge.behind.empty() && pose.stamp == edge.behind.back().stamp) return false;
  if (!edge.behind.empty() && pose.stamp < edge.behind.back().stamp) edge.behind.clear();
  edge.behind.push_back(pose);
  return edge.behind.size() >= kGoesOn;
}

void TfHistory::recordBehind(const std::string& child, Edge& edge, const TfPose& pose) {
  const auto next = std::lower_bound(edge.records.begin(), edge.records.end(), pose, isEarlier);
  if (next->stamp == pose.stamp) return;  // tf2 ignores a repeated time too
  ++out_of_order_;
  const TfPose& last = *std::prev(next);
  const bool rests = isSamePlace(last, pose) && isSamePlace(pose, *next);
  if (!rests) noteLate(edge, {child, last.stamp, next->stamp});
  if (edge.records.end() - next <= kMostBehind) {
    edge.records.insert(next, pose);
    return drop(edge);
  }
  // To put it in its place would cost more the more often it happens: nothing is known any more up to there.
  edge.dropped_until = pose.stamp;
  edge.is_cut = true;
  edge.records.erase(edge.records.begin(), next);
}

/// Of a time before all that is known.
void TfHistory::recordBefore(const std::string& child, Edge& edge, const TfPose& pose, bool is_same_parent) {
  ++out_of_order_;
  const ros::Time first = edge.records.front().stamp;
  if (pose.stamp <= edge.dropped_until) {
    noteLate(edge, {child, before(pose.stamp, keep_), edge.dropped_until});
  } else if (edge.is_cut) {
    noteLate(edge, {child, edge.dropped_until, first});
  } else if (is_same_parent && pose.stamp >= before(edge.records.back().stamp, keep_)) {
    edge.records.push_front(pose);  // nothing was known there
  }
}

void TfHistory::noteLate(Edge& edge, const LateTransforms& late) {
  if (edge.late.empty()) {
    edge.late = {late};
  } else {
    edge.late[0].since = std::min(edge.late[0].since, late.since);
    edge.late[0].until = std::max(edge.late[0].until, late.until);
  }
}

void TfHistory::clear() {
  for (auto edge = edges_.begin(); edge != edges_.end();) {
    if (!edge->second.is_static && !edge->second.is_followed) --others_[0];
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

long TfHistory::refused() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return refused_;
}

std::string TfHistory::refusal() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return refusal_;
}

long TfHistory::notKept() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return not_kept_;
}

bool TfHistory::takeMissedStatic() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (static_missed_) static_dropped_ = false;
  return std::exchange(static_missed_, false);
}

TfHistory::Way TfHistory::edgesUpwards(const std::string& frame) const {
  Way edges;
  auto edge = edges_.find(frame);
  while (edge != edges_.end() && edges.size() <= kMostAbove) {  // a loop is longer
    edges.push_back(&*edge);
    edge = edges_.find(edge->second.parent);
  }
  return edges;
}

std::vector<std::string> TfHistory::framesAbove(const std::string& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> above;
  for (const auto* edge : edgesUpwards(frame)) above.push_back(edge->second.parent);
  return above;
}

bool TfHistory::way(const std::string& frame, Way& up, Way& down, std::string& problem) const {
  up = edgesUpwards(frame);
  down = edgesUpwards(fixed_frame_);
  const auto rootOf = [](const std::string& from, const Way& edges) {
    return edges.empty() ? from : edges.back()->second.parent;
  };
  if (up.size() > kMostAbove || down.size() > kMostAbove) {
    problem = "the transforms above " + frame + " or " + fixed_frame_ + " are a loop, or more than " +
              std::to_string(kMostAbove);
    return false;
  }
  if (rootOf(frame, up) != rootOf(fixed_frame_, down)) {
    problem = "no transform from " + frame + " to " + fixed_frame_ + ": ";
    if (up.empty()) {
      problem += "none of " + frame + " has come";
    } else if (down.empty()) {
      problem += "tf's tree is rooted at " + rootOf(frame, up) + ", not " + fixed_frame_;
    } else {
      problem += "its tree is rooted at " + rootOf(frame, up) + ", that of " + fixed_frame_ + " at " +
                 rootOf(fixed_frame_, down);
    }
    return false;
  }
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    up.pop_back();
    down.pop_back();
  }
  std::reverse(down.begin(), down.end());
  return true;
}

TfHistory::Span TfHistory::span(const std::string& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return lockedSpan(frame);
}

std::vector<TfHistory::Span> TfHistory::takeNews(const std::vector<std::string>& frames) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Span> spans;
  for (const std::string& frame : frames) spans.push_back(lockedSpan(frame));
  for (auto& [child, edge] : edges_) edge.late.clear();
  return spans;
}

TfHistory::Span TfHistory::lockedSpan(const std::string& frame) const {
  Span span;
  Way up, down;
  if (!way(frame, up, down, span.problem)) return span;
  up.insert(up.end(), down.begin(), down.end());
  span.is_static = true;
  for (const auto* named : up) {
    const Edge& edge = named->second;
    if (edge.version > span.version) {
      span.version = edge.version;
      span.change = named->first + " " + edge.change;
    }
    span.late.insert(span.late.end(), edge.late.begin(), edge.late.end());
    span.first = std::max(span.first, edge.first());
    if (edge.is_static) continue;
    const ros::Time last = edge.records.back().stamp;
    span.last = span.is_static ? last : std::min(span.last, last);
    span.is_static = false;
  }
  return span;
}

void TfHistory::copy(const std::vector<std::string>& frames, const std::vector<TimePart>& parts,
                     const ros::Time& origin, TfWindow& window) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  struct Copied {
    std::size_t index;
    TimePart part;
  };
  std::unordered_map<Edges::const_pointer, Copied> copied;
  window.origin_ = origin;
  window.frames_.assign(frames.size(), {});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    TfWindow::Frame& frame = window.frames_[i];
    const TimePart& part = parts[i];
    frame.from = (part.from - origin).toSec();
    frame.until = (part.until - origin).toSec();
    Way up, down;
    if (!way(frames[i], up, down, frame.problem)) continue;
    const std::size_t ups = up.size();
    up.insert(up.end(), down.begin(), down.end());
    for (std::size_t k = 0; k < up.size(); ++k) {
      Copied& edge = copied.try_emplace(up[k], Copied{copied.size(), part}).first->second;
      edge.part = {std::min(edge.part.from, part.from), std::max(edge.part.until, part.until)};
      frame.way.push_back({edge.index, k < ups});
      describe(*up[k], part, frame);
    }
  }
  window.edges_.resize(copied.size());
  for (const auto& [named, edge] : copied) copyEdge(named->second, edge.part, origin, window.edges_[edge.index]);
}

/// What is not known of an edge over the part, told of a frame that it is on the way of.
void TfHistory::describe(Edges::const_reference named, const TimePart& part, TfWindow::Frame& frame) {
  const std::deque<TfPose>& records = named.second.records;
  frame.version = std::max(frame.version, named.second.version);
  if (part.from < named.second.first() || (!named.second.is_static && records.back().stamp < part.until)) {
    frame.problem = named.first + " is not known all the time";
  }
  for (auto record = lastUpTo(records, part.from); record != records.end(); ++record) {
    if (record->problem) frame.problem = named.first + " " + record->problem;
    if (named.second.is_static || record->stamp >= part.until) break;
    if (std::next(record) == records.end()) break;
    frame.longest_gap = std::max(frame.longest_gap, (std::next(record)->stamp - record->stamp).toSec());
  }
}

void TfHistory::copyEdge(const Edge& edge, const TimePart& part, const ros::Time& origin, TfWindow::Edge& copy) {
  copy.times.clear();
  copy.poses.clear();
  copy.pose_time = std::numeric_limits<double>::quiet_NaN();
  const std::deque<TfPose>& records = edge.records;
  const auto first = edge.is_static ? std::prev(records.end()) : lastUpTo(records, part.from);
  for (auto record = first; record != records.end(); ++record) {
    const bool is_last = std::next(record) == records.end() || record->stamp >= part.until;
    const bool rests = record != first && !is_last && isSamePlace(*std::prev(record), *record) &&
                       isSamePlace(*record, *std::next(record));
    if (!rests) {
      copy.times.push_back(edge.is_static ? 0.0 : (record->stamp - origin).toSec());
      copy.poses.push_back(*record);
    }
    if (is_last) break;
  }
}

bool TfHistory::lookup(const std::string& frame, const ros::Time& time, Isometry3d& X_WF, std::string& problem) const {
  X_WF.setIdentity();
  if (frame == fixed_frame_) return true;  // also if no transform names it
  const Span known = span(frame);
  problem = known.problem;
  if (!problem.empty()) return false;
  const ros::Time at = !time.isZero() ? time : known.is_static ? known.first : known.last;
  if (at < known.first || (!known.is_static && at > known.last)) {
    problem = frame + " is known from " + secondsText(known.first) +
              (known.is_static ? " on" : " to " + secondsText(known.last)) + ", not at " + secondsText(at);
    return false;
  }
  TfWindow window;
  copy({frame}, {{at, at}}, at, window);
  problem = window.problem(0);
  if (problem.empty()) X_WF = window.pose(0, 0.0);
  return problem.empty();
}

}  // namespace sdf_ccd
