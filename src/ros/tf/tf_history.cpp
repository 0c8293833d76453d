#include "ros/tf/tf_history.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/number_text.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

const ros::Duration kSimJumpBack(0.1);                  // two threads may see a simulated clock this much apart
constexpr std::uint32_t kLastSecond = 1u << 31;         // ros::Duration cannot hold differences to later stamps
constexpr std::size_t kLongestName = 256;               // characters in a frame's name
constexpr std::size_t kMaxUnfollowed[] = {1000, 5000};  // known frames that are not followed: moving, static
constexpr std::size_t kMaxUnfollowedRecords = 200;      // of one of them
constexpr double kMaxRecords = 1e6;                     // of all followed frames together
constexpr double kMinRecords = 1000.0;                  // of one followed frame, however many there are
constexpr double kRecordsPerSecond = 2000.0;            // of one followed frame, if there are few
const ros::Duration kSweepPeriod(1.0);

std::string_view bare(std::string_view frame) {
  const std::size_t start = frame.find_first_not_of('/');
  return start == std::string_view::npos ? std::string_view() : frame.substr(start);
}

}  // namespace

std::string withoutLeadingSlash(const std::string& frame) {
  return std::string(bare(frame));
}

TfHistory::TfHistory(const std::string& fixed_frame, const TfHistoryOptions& options)
    : fixed_frame_(withoutLeadingSlash(fixed_frame)),
      keep_(options.keep),
      tree_(options.wanted),
      fixed_(tree_.add(fixed_frame_)) {
  tree_.pin(fixed_);
}

void TfHistory::setExtraFrames(const std::vector<std::string>& frames) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (frames == extra_frames_) return;
  extra_frames_ = frames;
  tree_.setExtraFrames(frames);
  next_children_.resize(std::max(next_children_.size(), tree_.size()), TfTree::kNone);
  last_child_ = TfTree::kNone;
  static_missed_ |= static_dropped_;
}

void TfHistory::watchClock(const ros::Time& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool jumps = now < before(clock_, ros::Time::isSimTime() ? kSimJumpBack : ros::Duration(kJumpBack));
  if (jumps) clear();
  jumped_ |= jumps;
  clock_ = jumps ? now : std::max(clock_, now);
  if (clock_ < swept_ || before(clock_, kSweepPeriod) > swept_) forgetSilentFrames();
}

void TfHistory::add(const tf2_msgs::TFMessage& message, bool is_static) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    const Names names{bare(transform.child_frame_id), bare(transform.header.frame_id)};
    if (!isRefused(transform, names, is_static)) addOne(transform, names, is_static);
  }
}

void TfHistory::refuse(const std::string& why) {
  ++ignored_.refused;
  ignored_.refusal = why;
}

/// Whether a transform is invalid; it is then counted and ignored.
bool TfHistory::isRefused(const geometry_msgs::TransformStamped& transform, const Names& names, bool is_static) {
  const std::string &child = transform.child_frame_id, &parent = transform.header.frame_id;
  const ros::Time& stamp = transform.header.stamp;
  if (child.size() > kLongestName || parent.size() > kLongestName) {
    refuse("a frame's name has " + std::to_string(std::max(child.size(), parent.size())) + " characters");
  } else if (names.child.empty()) {
    refuse("a frame in " + parent + " has no name");
  } else if (names.parent.empty()) {
    refuse("the parent of " + child + " has no name");
  } else if (names.child == names.parent) {
    refuse(child + " is its own parent");
  } else if (is_static ||
             (stamp.sec < kLastSecond && (clock_.isZero() || stamp < clock_ || before(stamp, keep_) <= clock_))) {
    return false;
  } else {
    refuse(child + " is stamped " + secondsText(stamp.toSec(), 3) + ", when it is " + secondsText(clock_.toSec(), 3));
  }
  return true;
}

/// Expects the child that followed the last one before: publishers send their transforms in the same order every time.
int TfHistory::findChild(std::string_view name) {
  int* const next_child = last_child_ == TfTree::kNone ? nullptr : &next_children_[last_child_];
  int child = next_child ? *next_child : TfTree::kNone;
  if (child == TfTree::kNone || tree_.name(child) != name) child = tree_.find(name);
  if (next_child) *next_child = child;
  last_child_ = child;
  return child;
}

TfKeep TfHistory::keepOf(int frame) const {
  if (!tree_.isFollowed(frame)) return {keep_, kMaxUnfollowedRecords};
  const double share = kMaxRecords / static_cast<double>(tree_.followed() + 1);
  return {keep_, static_cast<std::size_t>(std::max(kMinRecords, std::min(share, kRecordsPerSecond * keep_.toSec())))};
}

void TfHistory::addOne(const geometry_msgs::TransformStamped& transform, const Names& names, bool is_static) {
  int child = findChild(names.child);
  const bool is_new = child == TfTree::kNone || !tree_.edge(child).isKnown();
  const bool is_added = is_new || tree_.edge(child).is_static != is_static;
  if (is_added && tree_.unfollowed(is_static) >= kMaxUnfollowed[is_static] &&
      (child == TfTree::kNone ? !tree_.followsAll() : !tree_.isFollowed(child))) {
    ++ignored_.not_kept;
    static_dropped_ |= is_static;
    return;
  }
  const ros::Time& sent = transform.header.stamp;
  const ros::Time stamp = is_static ? ros::Time() : ros::Time(sent.sec, sent.nsec);  // nsec may exceed one second
  const TfPose pose = toTfPose(stamp, transform.transform);
  if (child == TfTree::kNone) {
    child = last_child_ = tree_.add(names.child);
    next_children_.resize(tree_.size(), TfTree::kNone);
  }
  TfEdge& edge = tree_.edge(child);
  edge.received = clock_;
  const bool was_late = edge.late.has_value();
  const bool is_same_kind = edge.is_static == is_static;
  const bool is_same_parent = !is_new && tree_.name(tree_.parent(child)) == names.parent;
  if (!is_new && is_same_kind && is_same_parent && (!is_static || isSamePose(edge.records.back(), pose))) {
    if (!is_static) edge.record(pose, keepOf(child), counts_);
  } else if (!is_new && is_same_kind && !is_static && stamp < edge.records.front().stamp && !edge.hasGoneBack(pose)) {
    edge.recordBefore(pose, is_same_parent, keepOf(child), counts_);
  } else {
    std::string change = "is new in tf";
    if (!is_new && !is_same_kind) {
      change = is_static ? "has become static" : "is no longer static";
    } else if (!is_new) {
      change = is_same_parent ? "has another static transform"
                              : "has another parent, " + std::string(names.parent) + " instead of " +
                                    tree_.name(tree_.parent(child));
    }
    ros::Time last = edge.dropped_until;
    if (!is_new && !edge.is_static) last = std::max(last, edge.records.back().stamp);
    if (!clock_.isZero()) last = std::min(last, clock_);  // no cycle has gone beyond the clock
    edge.restart(pose, change, counts_);
    edge.dropped_until = last;
    setParent(child, tree_.add(names.parent), is_static);
    // Cycles may have gone beyond the stamp already, with the frame's former transforms.
    if (!is_new && !is_static) edge.noteLate({stamp, ros::TIME_MAX});
  }
  if (edge.late && !was_late) late_.push_back(child);
}

void TfHistory::setParent(int frame, int parent, bool is_static) {
  next_children_.resize(tree_.size(), TfTree::kNone);
  const bool is_new_above = tree_.isFollowed(frame) && !tree_.isFollowed(parent);
  for (const int changed : tree_.setEdge(frame, parent, is_static)) {
    if (!tree_.edge(changed).is_static) tree_.edge(changed).drop(keepOf(changed));
  }
  if (!is_new_above || !static_dropped_) return;
  std::vector<int> above;
  tree_.upwards(parent, above);
  static_missed_ |= tree_.root(parent, above) != fixed_;
}

/// Makes room for other frames, and breaks loops whose sender has gone; a moving frame becomes known again with its
/// next transform.
void TfHistory::forgetSilentFrames() {
  swept_ = clock_;
  const ros::Time silent_since = before(clock_, keep_);
  // Static frames do not fall silent, but those that a body has once hung on may be more than there is room for.
  const bool has_room = tree_.unfollowed(true) <= kMaxUnfollowed[true];
  static_dropped_ |= !has_room;
  std::vector<int> above;
  for (int frame = 0; frame < static_cast<int>(tree_.size()); ++frame) {
    const TfEdge& edge = tree_.edge(frame);
    if (!edge.isKnown()) continue;
    const bool is_silent = !edge.is_static && edge.received < silent_since;
    if (!tree_.isFollowed(frame)) {
      if (edge.is_static ? !has_room : is_silent) tree_.forget(frame);
    } else if (is_silent) {
      tree_.upwards(frame, above);
      if (above.size() > kMaxAbove) tree_.forget(frame);
    }
  }
}

void TfHistory::clear() {
  for (int frame = 0; frame < static_cast<int>(tree_.size()); ++frame) {
    if (tree_.edge(frame).isKnown() && !tree_.edge(frame).is_static) tree_.forget(frame);
  }
}

void TfHistory::forgetMoving() {
  const std::lock_guard<std::mutex> lock(mutex_);
  clear();
}

bool TfHistory::takeJump() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(jumped_, false);
}

std::vector<std::string> TfHistory::frames() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> names;
  for (int frame = 0; frame < static_cast<int>(tree_.size()); ++frame)
    if (tree_.parent(frame) != TfTree::kNone) names.push_back(tree_.name(frame));
  return names;
}

TfIgnored TfHistory::ignored() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  TfIgnored ignored = ignored_;
  ignored.out_of_order = counts_.out_of_order;
  return ignored;
}

bool TfHistory::takeMissedStatic() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (static_missed_) static_dropped_ = false;
  return std::exchange(static_missed_, false);
}

std::vector<std::string> TfHistory::framesAbove(const std::string& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const int number = tree_.find(frame);
  std::vector<int> edges;
  if (number != TfTree::kNone) tree_.upwards(number, edges);
  std::vector<std::string> above;
  for (const int edge : edges) above.push_back(tree_.name(tree_.parent(edge)));
  return above;
}

void TfHistory::spans(TfChains& chains, std::vector<TfSpan>& spans) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  chains.update(tree_, fixed_);
  chains.spans(tree_, !late_.empty(), spans);
}

void TfHistory::takeSpans(TfChains& chains, std::vector<TfSpan>& spans) {
  const std::lock_guard<std::mutex> lock(mutex_);
  chains.update(tree_, fixed_);
  chains.spans(tree_, !late_.empty(), spans);
  for (const int frame : late_) tree_.edge(frame).late.reset();
  late_.clear();
}

TfSpan TfHistory::span(const std::string& frame) const {
  TfChains chains({frame});
  std::vector<TfSpan> known;
  spans(chains, known);
  return known[0];
}

void TfHistory::copy(TfChains& chains, const std::vector<TimePart>& parts, const ros::Time& origin,
                     TfWindow& window) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  chains.update(tree_, fixed_);
  chains.copy(tree_, parts, origin, window);
}

bool TfHistory::lookup(const std::string& frame, const ros::Time& time, Isometry3d& X_WF, std::string& problem,
                       double max_gap) const {
  X_WF.setIdentity();
  if (frame == fixed_frame_) return true;  // also if no transform names it
  TfChains chains({frame});
  std::vector<TfSpan> spans_;
  spans(chains, spans_);
  const TfSpan& known = spans_[0];
  problem = known.problem;
  if (!problem.empty()) return false;
  const ros::Time at = !time.isZero() ? time : known.is_static ? known.first : known.last;
  if (at < known.first || (!known.is_static && at > known.last)) {
    problem = frame + " is known from " + secondsText(known.first.toSec(), 3) +
              (known.is_static ? " on" : " to " + secondsText(known.last.toSec(), 3)) + ", not at " +
              secondsText(at.toSec(), 3);
    return false;
  }
  TfWindow window;
  copy(chains, {{at, at}}, at, window);
  problem = window.problem(0);
  if (problem.empty() && window.longestGap(0) > max_gap)
    problem = fmt::format("{} has no transform for {:.3f} s, about {}", frame, window.longestGap(0),
                          secondsText(at.toSec(), 3));
  if (problem.empty()) X_WF = window.pose(0, 0.0);
  return problem.empty();
}

}  // namespace sdf_ccd
