#pragma once

#include <string>
#include <vector>

#include "ros/tf/tf_tree.h"
#include "ros/tf/tf_window.h"

namespace sdf_ccd {

/// Transforms of one frame that came behind newer ones: what was interpolated in their place was wrong.
struct LateTransforms {
  std::string frame;
  ros::Time since, until;  ///< where the frame's motion is another than what was known before
};

/// What is known of the way from the fixed frame to a frame.
struct TfSpan {
  std::string problem;  ///< why there is no way; empty if there is one
  bool is_static = false;
  ros::Time first, last;             ///< known from when to when; `last` is not set if static
  long version = 0;                  ///< another one after the way has changed otherwise than by moving
  std::string change;                ///< what has changed last, if version is not 0
  std::vector<LateTransforms> late;  ///< on the way, since the last news
};

/// The ways from the fixed frame to some frames, all as one tree whose root is the fixed frame. They are kept until a
/// frame comes, goes, or gets another parent; each step is looked at once for all frames behind it.
///
/// Used through a TfHistory, which guards the transforms.
class TfChains {
 public:
  explicit TfChains(std::vector<std::string> frames);

  const std::vector<std::string>& frames() const { return frames_; }

  /// Finds the ways anew if they may have changed. Call it before the others.
  void update(const TfTree& tree, int fixed_frame);

  /// @param spans  per frame; their memory is used again.
  void spans(const TfTree& tree, bool any_late, std::vector<TfSpan>& spans);

  /// How the frames move, each during its part, for the window.
  void copy(const TfTree& tree, const std::vector<TimePart>& parts, const ros::Time& origin, TfWindow& window);

 private:
  struct Step {
    int edge;         // its child frame
    int before;       // the step before it, nearer to the fixed frame; -1 if it begins there
    bool is_inverse;  // leads to the parent, not the child
  };
  struct StepSpan {
    ros::Time first, last;
    bool is_static = true;
    long version = 0;
    int changed = TfTree::kNone;
  };
  struct RecordedPart {  // what of an edge is interpolated over a part of the time
    ros::Time first, last;
    double longest_gap = 0.0;
  };
  struct Account {  // of the way up to a step, over a part of the time
    TimePart part;
    long version = 0;
    double longest_gap = 0.0;
    double gaps = 0.0;     // of all edges, but those stamped as the one before them
    RecordedPart moved{};  // of the last edge that moves
    int problem_edge = TfTree::kNone;
    const char* problem = nullptr;
  };
  struct Way {
    int step = -1;  // the last one; -1 for the fixed frame
    std::string problem;
  };

  void find(const TfTree& tree, int fixed_frame, const std::string& frame, Way& way);
  int stepTo(int frame, const Step& step);
  const Account& account(const TfTree& tree, int step, const TimePart& part);

  std::vector<std::string> frames_;
  std::vector<std::size_t> first_of_;  // per frame: the first of that name
  long topology_ = -1;
  bool depends_on_all_ = false;  // on frames that are not followed
  std::vector<Step> steps_;      // each behind the one before it
  std::vector<Way> ways_;        // per frame

  std::vector<int> steps_to_;  // per frame of the tree; -1 if there is none
  std::vector<int> up_, down_, above_;
  std::vector<StepSpan> step_spans_;
  std::vector<TimePart> step_parts_;
  std::vector<Account> accounts_;  // per step, of the part that it was asked about last
};

}  // namespace sdf_ccd
