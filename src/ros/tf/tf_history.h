#pragma once

#include <limits>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <tf2_msgs/TFMessage.h>

#include "ros/tf/tf_chains.h"

namespace sdf_ccd {

/// Without leading slashes: tf2 strips them on arrival but refuses them in look-ups.
std::string withoutLeadingSlash(const std::string& frame);

/// Numbers of transforms that were received too late or for nothing.
struct TfIgnored {
  long out_of_order = 0;  ///< that arrived after newer ones of the same frame; these are used
  long not_kept = 0;      ///< whose frames are not followed, and for which there was no room
  /// Without frame names or with names of more than 256 characters, of a frame in itself, or stamped in the future.
  long refused = 0;
  std::string refusal;  ///< reason of the last refusal; empty if there was none
};

/// Frames and time span that a TfHistory keeps.
struct TfHistoryOptions {
  std::vector<std::string> wanted;  ///< frames to follow, with all frames above them; empty: every frame
  double keep = 10.0;               ///< time for which moving transforms are kept, as in tf2's buffer [s]
};

/// Buffer of the transforms of the last seconds. It interpolates them as tf2 does and also knows the times at which
/// they were recorded. Unlike tf2's buffer it
///  - lets a frame change from static to moving and back, and to another parent: its records then start over;
///  - reports transforms that arrive after newer ones;
///  - keeps transforms that are no rigid motion, as a problem of their frame at that time.
///
/// Its memory and run time are bounded, whatever other nodes send: it keeps about a million records in all and, if few
/// frames are followed, those of each at up to 2 kHz. Of frames that are not followed (a query may be given in one) it
/// keeps a thousand moving ones with their last records, while they are being sent, and five thousand static ones.
/// Static transforms are sent only once: takeMissedStatic() reports when one may be needed that had no room.
///
/// A transform that continues the last one of its frame costs two comparisons of names and one slot of a ring buffer,
/// whatever the number of frames; no memory is allocated once the rings hold what is kept. Thread-safe.
class TfHistory {
 public:
  explicit TfHistory(const std::string& fixed_frame, const TfHistoryOptions& options = {});

  const std::string& fixedFrame() const { return fixed_frame_; }

  /// Also follows these frames, instead of those of the last call. Costs nothing if they are the same.
  void setExtraFrames(const std::vector<std::string>& frames);

  /// Adds a message of /tf or /tf_static. If a frame's stamps go back by more than a second and continue from there,
  /// its records start over; a single old transform is a late one.
  void add(const tf2_msgs::TFMessage& message, bool is_static);

  /// Takes the time of the ROS clock, 0 if it does not run yet. If the clock goes back, everything but static
  /// transforms is cleared. Transforms stamped later than the clock by more than `keep` are refused: they say nothing
  /// about the present.
  void watchClock(const ros::Time& now);

  /// Forgets all but static transforms, which are sent only once. This also breaks a loop, whichever node sent it.
  void forgetMoving();

  /// True once after the clock has gone back.
  bool takeJump();

  /// What is known of the chains' frames, from one consistent state: a message that is being added counts as a whole or
  /// not at all.
  /// @param spans  its memory is reused.
  void spans(TfChains& chains, std::vector<TfSpan>& spans) const;

  /// The same; each late transform is reported once.
  void takeSpans(TfChains& chains, std::vector<TfSpan>& spans);

  /// The same for one frame.
  TfSpan span(const std::string& frame) const;

  /// Copies the motion of the chains' frames, each during its part, to the window.
  void copy(TfChains& chains, const std::vector<TimePart>& parts, const ros::Time& origin, TfWindow& window) const;

  /// Pose of the frame in the fixed frame, interpolated as by tf2; time 0 is the latest. Returns false, with the
  /// reason, if it is not known: nothing is extrapolated.
  /// @param max_gap  longest time between two transforms to interpolate between [s].
  bool lookup(const std::string& frame, const ros::Time& time, Isometry3d& X_WF, std::string& problem,
              double max_gap = std::numeric_limits<double>::infinity()) const;

  /// The frames above a frame, the nearest first.
  std::vector<std::string> framesAbove(const std::string& frame) const;

  /// All frames of which a transform is known.
  std::vector<std::string> frames() const;

  TfIgnored ignored() const;

  /// True once after a followed frame has become the child of a frame whose static transform may have been dropped: the
  /// static transforms have to be requested again from their publishers.
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
  void forgetSilentFrames();
  void clear();

  const std::string fixed_frame_;
  const ros::Duration keep_;
  mutable std::mutex mutex_;
  TfTree tree_;
  std::vector<std::string> extra_frames_;
  int fixed_;                       // the fixed frame's number
  std::vector<int> next_children_;  // per frame: the frame whose transform followed last time
  int last_child_ = TfTree::kNone;
  TfCounts counts_;
  std::vector<int> late_;  // frames with late transforms
  ros::Time clock_;
  ros::Time swept_;  // time at which silent frames were last forgotten
  bool jumped_ = false;
  TfIgnored ignored_;
  bool static_dropped_ = false;  // since takeMissedStatic() last returned true
  bool static_missed_ = false;
};

}  // namespace sdf_ccd
