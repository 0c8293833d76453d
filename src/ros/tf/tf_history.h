#pragma once

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <tf2_msgs/TFMessage.h>

#include "ros/tf/tf_chains.h"

namespace sdf_ccd {

/// Without leading slashes: tf2 strips them on arrival but refuses them in look-ups.
std::string withoutLeadingSlash(const std::string& frame);

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
///
/// A transform that goes on from the last one of its frame costs two comparisons of names and a place in a ring,
/// however many there are; no memory is taken once the rings hold what is kept. Thread-safe.
class TfHistory {
 public:
  explicit TfHistory(const std::string& fixed_frame, const TfHistoryOptions& options = {});

  const std::string& fixedFrame() const { return fixed_frame_; }

  /// Follows these frames too, and no longer those that the last call named. Costs nothing if they are the same.
  void wantBesides(const std::vector<std::string>& frames);

  /// Takes over a message of /tf or /tf_static. Of a frame whose stamps have gone back by more than a second, and go on
  /// from there, what is known begins anew; a single old transform is a late one.
  void add(const tf2_msgs::TFMessage& message, bool is_static);

  /// Watches the ROS clock, 0 if it does not run yet. A clock that goes back clears everything but static transforms.
  /// Transforms stamped later than it by more than is kept are refused: of now they could tell nothing.
  void watchClock(const ros::Time& now);

  /// Forgets all but static transforms, which are sent only once. So also those that made a loop, whoever sent them.
  void forgetMoving();

  /// True once after the clock has gone back.
  bool takeJump();

  /// What is known of the ways to the chains' frames, all before or all after a message that is being added.
  /// @param spans  their memory is used again.
  void spans(TfChains& chains, std::vector<TfSpan>& spans) const;

  /// The same; what is late is told once.
  void takeNews(TfChains& chains, std::vector<TfSpan>& spans);

  /// Of one frame.
  TfSpan span(const std::string& frame) const;

  /// How the chains' frames move, each during its part.
  void copy(TfChains& chains, const std::vector<TimePart>& parts, const ros::Time& origin, TfWindow& window) const;

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
  struct Names {
    std::string_view child, parent;  // without leading slashes
  };

  bool isRefused(const geometry_msgs::TransformStamped& transform, const Names& names, bool is_static);
  void refuse(const std::string& why);
  void addOne(const geometry_msgs::TransformStamped& transform, const Names& names, bool is_static);
  int findChild(std::string_view name);
  void setParent(int frame, int parent, bool is_static);
  TfKeep keepOf(int frame) const;
  void forgetSilentOthers();
  void clear();

  const std::string fixed_frame_;
  const ros::Duration keep_;
  mutable std::mutex mutex_;
  TfTree tree_;
  std::vector<std::string> besides_;
  int fixed_;                   // the fixed frame's number
  std::vector<int> followers_;  // per frame: the one that came behind it last
  int last_child_ = TfTree::kNone;
  TfCounts counts_;
  std::vector<int> late_;  // frames of which something is late
  ros::Time clock_;
  ros::Time swept_;  // when silent frames were forgotten
  bool jumped_ = false;
  long refused_ = 0;
  long not_kept_ = 0;
  bool static_dropped_ = false;  // since takeMissedStatic() was true
  bool static_missed_ = false;
  std::string refusal_;
};

}  // namespace sdf_ccd
