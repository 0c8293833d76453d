#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "ros/tf/tf_poses.h"

namespace sdf_ccd {

/// time - duration, or 0 if that is negative.
ros::Time before(const ros::Time& time, const ros::Duration& duration);

/// Limits of what is kept of an edge.
struct TfKeep {
  ros::Duration duration;  ///< before its newest transform
  std::size_t records = 0;
};

/// Counts of events, over all edges.
struct TfCounts {
  long changes = 0;       ///< changes otherwise than by moving
  long out_of_order = 0;  ///< transforms that arrived after newer ones of the same frame
};

/// The transforms of a frame in its parent.
struct TfEdge {
  bool is_static = false;
  TfPoses records;          ///< one if static; empty if no transform of the frame is known
  ros::Time dropped_until;  ///< transforms up to this time were known and have been dropped
  bool is_cut = false;      ///< the dropped transforms continued to the first record, without a change between them
  long version = 0;         ///< value of TfCounts::changes after the last change
  std::string change;       ///< what that change was, to be read after the frame's name
  ros::Time received;       ///< time of the clock when the last transform arrived

  /// Period in which the frame's motion differs from what was known before. The history reports it once, then resets
  /// it.
  struct Late {
    ros::Time since, until;
  };
  std::optional<Late> late;

  bool isKnown() const { return !records.empty(); }

  /// Time from which on the frame is known: not before dropped_until, up to where the frame was known as it was before
  /// a change, even if the change itself is stamped earlier.
  ros::Time first() const { return is_static ? dropped_until : std::max(records.front().stamp, dropped_until); }

  /// Records a transform of a moving frame in the same parent.
  void record(const TfPose& pose, const TfKeep& keep, TfCounts& counts);

  /// Handles a transform stamped before all records.
  void recordBefore(const TfPose& pose, bool is_same_parent, const TfKeep& keep, TfCounts& counts);

  /// Whether the stamps have gone back: kMinBehind transforms in a row are far older than the newest one. Call it once
  /// per transform.
  bool hasGoneBack(const TfPose& pose);

  /// Drops all records and starts with this one.
  void restart(const TfPose& pose, const std::string& what_changed, TfCounts& counts);

  /// Drops the records beyond the limits.
  void drop(const TfKeep& keep);

  void noteLate(const Late& more);

  /// Drops all records.
  void clear();

 private:
  void recordBehind(const TfPose& pose, const TfKeep& keep, TfCounts& counts);

  static constexpr std::size_t kMinBehind = 2;  // this many in a row far behind the newest: the stamps have gone back
  std::array<TfPose, kMinBehind> behind_;       // the last transforms, while all of them are far behind the newest
  std::size_t behind_count_ = 0;
};

}  // namespace sdf_ccd
