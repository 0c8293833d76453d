#pragma once

#include <algorithm>
#include <deque>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include <tf2_msgs/TFMessage.h>

#include "ros/followed_frames.h"
#include "ros/tf_window.h"

namespace sdf_ccd {

/// Without leading slashes: tf2 strips them on arrival but refuses them in look-ups.
std::string withoutLeadingSlash(const std::string& frame);

/// Transforms of one frame that came behind newer ones: what was interpolated in their place was wrong.
struct LateTransforms {
  std::string frame;
  ros::Time since, until;  ///< where the frame's motion is another than what was known before
};

/// What a TfHistory keeps.
struct TfHistoryOptions {
  std::vector<std::string> wanted;  ///< frames to follow, with all above them; none: every frame
  double keep = 10.0;               ///< moving transforms are kept as long, as tf2's buffer does [s]
};

/// The transforms of the last seconds. It interpolates them as tf2 does, and knows besides at which times they were
/// recorded. Unlike tf2's buffer it
///  - lets a frame change from static to moving and back, and to another parent: what is known of it begins anew;
///  - tells what came behind newer transforms;
///  - keeps transforms that are no rigid motion, as a problem of their frame at that time.
///
/// What nodes send cannot make it grow, or slow, without bound: about a million records are kept in all, those of a
/// frame at twice a kilohertz at least where there are few. Of frames that are not followed, so that a query may be
/// given in one, a thousand moving ones with their last records, as long as they come, and five thousand static ones.
/// Static ones are sent once: takeMissedStatic() tells when one may be needed that had no room.
/// Thread-safe.
class TfHistory {
 public:
  explicit TfHistory(const std::string& fixed_frame, const TfHistoryOptions& options = {});

  const std::string& fixedFrame() const { return fixed_frame_; }

  /// Takes over a message of /tf or /tf_static. Of a frame whose stamps have gone back by more than a second, and go on
  /// from there, what is known begins anew; a single old transform is a late one.
  void add(const tf2_msgs::TFMessage& message, bool is_static);

  /// Watches the ROS clock, 0 if it does not run yet. A clock that goes back clears everything but static transforms.
  /// Transforms stamped later than it by more than is kept are refused: of now they could tell nothing.
  void watchClock(const ros::Time& now);

  /// True once after the clock has gone back.
  bool takeJump();

  /// What is known of the way from the fixed frame to a frame.
  struct Span {
    std::string problem;  ///< why there is no way; empty if there is one
    bool is_static = false;
    ros::Time first, last;             ///< known from when to when; `last` is not set if static
    long version = 0;                  ///< another one after the way has changed otherwise than by moving
    std::string change;                ///< what has changed last
    std::vector<LateTransforms> late;  ///< on the way, since the last news
  };
  Span span(const std::string& frame) const;

  /// The same of several frames, all before or all after a message that is being added. What is late is told once.
  std::vector<Span> takeNews(const std::vector<std::string>& frames);

  /// How frames move, each during its part.
  void copy(const std::vector<std::string>& frames, const std::vector<TimePart>& parts, const ros::Time& origin,
            TfWindow& window) const;

  /// Pose of the frame in the fixed frame, as tf2 interpolates it; time 0 is the latest. False, with the reason, if
  /// it is not known: nothing is extrapolated.
  bool lookup(const std::string& frame, const ros::Time& time, Isometry3d& X_WF, std::string& problem) const;

  /// The frames above a frame, the nearest first.
  std::vector<std::string> framesAbove(const std::string& frame) const;

  /// Transforms that came behind newer ones of the same frame.
  long outOfOrder() const;

  /// Transforms that say nothing: without frames or with names of more than 256 characters, of a frame in itself, or
  /// stamped in the future.
  long refused() const;

  /// What was wrong with the last of them; empty if there was none.
  std::string refusal() const;

  /// Transforms of frames that are not followed and had no room.
  long notKept() const;

  /// True once after a frame that is followed now has come to hang on one whose static transform may have been dropped:
  /// whoever sent static transforms has to be asked for them again.
  bool takeMissedStatic();

 private:
  struct Edge {  // from a frame to its parent
    std::string parent;
    bool is_static = false;
    std::deque<TfPose> records;  // one if static
    ros::Time dropped_until;     // up to here older transforms were known once
    bool is_cut = false;         // what was dropped went on to the records
    std::deque<TfPose> behind;   // the last ones, as long as all of them are far behind the newest
    long version = 0;
    const char* change = "";
    bool is_followed = true;
    ros::Time heard;  // the clock at the last transform

    /// What the frame was before a change was known up to dropped_until, or the change was said to be earlier.
    ros::Time first() const { return is_static ? dropped_until : std::max(records.front().stamp, dropped_until); }
    std::vector<LateTransforms> late;  // one or none
  };
  using Edges = std::unordered_map<std::string, Edge>;  // by child frame
  using Way = std::vector<Edges::const_pointer>;

  void addOne(const geometry_msgs::TransformStamped& transform, bool is_static);
  void refuse(const std::string& why);
  std::string problemOf(const geometry_msgs::TransformStamped& transform, bool is_static) const;
  void setParent(Edge& edge, const std::string& parent, bool is_static);
  void followAbove(const std::string& parent);
  void setFollowed(Edge& edge, bool is_followed);
  void forgetSilentOthers();
  void drop(Edge& edge) const;
  void record(const std::string& child, Edge& edge, const TfPose& pose);
  void recordBehind(const std::string& child, Edge& edge, const TfPose& pose);
  void recordBefore(const std::string& child, Edge& edge, const TfPose& pose, bool is_same_parent);
  bool hasGoneBack(Edge& edge, const TfPose& pose);
  void beginAnew(Edge& edge, const std::deque<TfPose>& records, const char* change);
  void clear();
  static void noteLate(Edge& edge, const LateTransforms& late);
  static void describe(Edges::const_reference named, const TimePart& part, TfWindow::Frame& frame);
  static void copyEdge(const Edge& edge, const TimePart& part, const ros::Time& origin, TfWindow::Edge& copy);
  Span lockedSpan(const std::string& frame) const;
  bool way(const std::string& frame, Way& up, Way& down, std::string& problem) const;
  Way edgesUpwards(const std::string& frame) const;

  const std::string fixed_frame_;
  const ros::Duration keep_;
  mutable std::mutex mutex_;
  Edges edges_;
  FollowedFrames followed_;
  std::size_t others_[2] = {0, 0};  // edges that are not followed: moving, static
  ros::Time clock_;
  ros::Time swept_;  // when silent frames were forgotten
  bool jumped_ = false;
  long versions_ = 0;
  long out_of_order_ = 0;
  long refused_ = 0;
  long not_kept_ = 0;
  bool static_dropped_ = false;  // since takeMissedStatic() was true
  bool static_missed_ = false;
  std::string refusal_;
};

}  // namespace sdf_ccd
