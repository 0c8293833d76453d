#include "ros/tf/tf_edge.h"

#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxBehind = 1000;  // a late transform is inserted only before at most this many records

}  // namespace

ros::Time before(const ros::Time& time, const ros::Duration& duration) {
  const std::uint64_t end = time.toNSec(), length = static_cast<std::uint64_t>(duration.toNSec());
  if (end <= length) return {};
  return ros::Time().fromNSec(end - length);  // time - duration takes several divisions, for every transform
}

void TfEdge::record(const TfPose& pose, const TfKeep& keep, TfCounts& counts) {
  if (pose.stamp > records.back().stamp) {
    behind_count_ = 0;
    records.pushBack(pose);
    // A record older than dropped_until arrived late, under another parent. Interpolating from it to this one would
    // cross a period in which other transforms were known.
    while (records.front().stamp < dropped_until && pose.stamp > dropped_until) records.dropFront(1);
    drop(keep);
  } else if (hasGoneBack(pose)) {
    const std::array<TfPose, kMinBehind> restarted = behind_;
    restart(restarted[0], "has stamps that went back", counts);
    for (std::size_t i = 1; i < kMinBehind; ++i) records.pushBack(restarted[i]);
  } else if (pose.stamp < records.front().stamp) {
    recordBefore(pose, true, keep, counts);
  } else {
    recordBehind(pose, keep, counts);
  }
}

void TfEdge::recordBehind(const TfPose& pose, const TfKeep& keep, TfCounts& counts) {
  const std::size_t last = records.lastUpTo(pose.stamp), next = last + 1;
  if (records[last].stamp == pose.stamp) return;  // tf2 ignores a repeated time too
  ++counts.out_of_order;
  const bool rests = isSamePose(records[last], pose) && isSamePose(pose, records[next]);
  if (!rests) noteLate({records[last].stamp, records[next].stamp});
  if (records.size() - next <= kMaxBehind) {
    records.insert(next, pose);
    return drop(keep);
  }
  // Each insertion would cost more the more often this happens. Instead, all records up to its time are dropped.
  dropped_until = pose.stamp;
  is_cut = true;
  records.dropFront(next);
}

void TfEdge::recordBefore(const TfPose& pose, bool is_same_parent, const TfKeep& keep, TfCounts& counts) {
  ++counts.out_of_order;
  if (pose.stamp <= dropped_until) {
    noteLate({before(pose.stamp, keep.duration), dropped_until});
  } else if (is_cut) {
    noteLate({dropped_until, records.front().stamp});
  } else if (is_same_parent && pose.stamp >= before(records.back().stamp, keep.duration)) {
    records.insert(0, pose);  // no motion was known at that time
    drop(keep);
  }
}

bool TfEdge::hasGoneBack(const TfPose& pose) {
  if (pose.stamp >= before(records.back().stamp, ros::Duration(kJumpBack))) return false;
  if (behind_count_ > 0 && pose.stamp == behind_[behind_count_ - 1].stamp) return false;
  if (behind_count_ > 0 && pose.stamp < behind_[behind_count_ - 1].stamp) behind_count_ = 0;
  behind_[behind_count_++] = pose;
  return behind_count_ == kMinBehind;
}

void TfEdge::restart(const TfPose& pose, const std::string& what_changed, TfCounts& counts) {
  clear();
  records.pushBack(pose);
  version = ++counts.changes;
  change = what_changed;
}

void TfEdge::drop(const TfKeep& keep) {
  const ros::Time oldest = before(records.back().stamp, keep.duration);
  std::size_t count = 0;
  while (records[count].stamp < oldest || records.size() - count > keep.records) ++count;
  if (count == 0) return;
  dropped_until = records[count - 1].stamp;
  is_cut = true;
  records.dropFront(count);
}

void TfEdge::noteLate(const Late& more) {
  late = late ? Late{std::min(late->since, more.since), std::max(late->until, more.until)} : more;
}

void TfEdge::clear() {
  records.clear();
  dropped_until = ros::Time();
  is_cut = false;
  behind_count_ = 0;
}

}  // namespace sdf_ccd
