#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "ros/tf/tf_poses.h"

namespace sdf_ccd {

/// The time minus the duration, or 0 if there is none before it.
ros::Time before(const ros::Time& time, const ros::Duration& duration);

/// How much is kept of an edge.
struct TfKeep {
  ros::Duration duration;  ///< behind its newest transform
  std::size_t records = 0;
};

/// What happens to edges, counted.
struct TfCounts {
  long changes = 0;       ///< otherwise than by moving
  long out_of_order = 0;  ///< transforms that came behind newer ones of the same frame
};

/// The transforms of a frame in its parent.
struct TfEdge {
  bool is_static = false;
  TfPoses records;          ///< one if static; none: no transform of the frame is known
  ros::Time dropped_until;  ///< up to here older transforms were known once
  bool is_cut = false;      ///< what was dropped went on to the records
  long version = 0;         ///< TfCounts::changes at the last one
  std::string change;       ///< what that was, as in "hand …"
  ros::Time heard;          ///< the clock at the last transform

  /// Where the frame's motion is another than what was known before: told, and then forgotten, by the history.
  struct Late {
    ros::Time since, until;
  };
  std::optional<Late> late;

  bool isKnown() const { return !records.empty(); }

  /// What the frame was before a change was known up to dropped_until, or the change was said to be earlier.
  ros::Time first() const { return is_static ? dropped_until : std::max(records.front().stamp, dropped_until); }

  /// Takes a transform by the same parent, both moving.
  void record(const TfPose& pose, const TfKeep& keep, TfCounts& counts);

  /// Takes one of a time before all that is known.
  void recordBefore(const TfPose& pose, bool is_same_parent, const TfKeep& keep, TfCounts& counts);

  /// Whether the stamps go on far behind the newest. Call it once per transform.
  bool hasGoneBack(const TfPose& pose);

  /// Nothing of before holds any more.
  void beginAnew(const TfPose& pose, const std::string& what_has_changed, TfCounts& counts);

  /// Drops what is too old, or too much.
  void drop(const TfKeep& keep);

  void noteLate(const Late& more);

  /// Forgets the transforms.
  void clear();

 private:
  void recordBehind(const TfPose& pose, const TfKeep& keep, TfCounts& counts);

  static constexpr std::size_t kGoesOn = 2;  // so many far behind the newest, one after the other, are no late ones
  std::array<TfPose, kGoesOn> behind_;       // the last ones, as long as all of them are far behind the newest
  std::size_t behind_count_ = 0;
};

}  // namespace sdf_ccd
