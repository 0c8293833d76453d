#pragma once

#include <string>
#include <vector>

#include "ros/tf/tf_tree.h"
#include "ros/tf/tf_window.h"

namespace sdf_ccd {

/// Transforms of one frame that arrived after newer ones: earlier interpolation across their times was wrong.
struct LateTransforms {
  std::string frame;
  ros::Time since, until;  ///< period in which the frame's motion differs from what was known before
};

/// What is known of the chain of transforms from the fixed frame to a frame.
struct TfSpan {
  std::string problem;  ///< why there is no chain; empty if there is one
  bool is_static = false;
  ros::Time first, last;             ///< period in which the chain is known; `last` is not set if static
  long version = 0;                  ///< another one after the chain has changed otherwise than by moving
  std::string change;                ///< the last such change, if version is not 0
  std::vector<LateTransforms> late;  ///< on the chain, since the last TfHistory::takeSpans()
};

/// The chains of transforms from the fixed frame to some frames, as one tree rooted at the fixed frame. They are kept
/// until a frame appears, disappears or gets another parent; each step is evaluated once for all frames behind it.
///
/// Used through a TfHistory, which guards the transforms.
class TfChains {
 public:
  explicit TfChains(std::vector<std::string> frames);

  const std::vector<std::string>& frames() const { return frames_; }

  /// Rebuilds the chains if they may have changed. Call it before the other functions.
  void update(const TfTree& tree, int fixed_frame);

  /// @param spans  one per frame; its memory is reused.
  void spans(const TfTree& tree, bool any_late, std::vector<TfSpan>& spans);

  /// Copies the motion of the frames, each during its part, to the window.
  void copy(const TfTree& tree, const std::vector<TimePart>& parts, const ros::Time& origin, TfWindow& window);

 private:
  struct Step {
    int edge;         // number of its child frame
    int before;       // index of the step before it, nearer to the fixed frame; -1 if there is none
    bool is_inverse;  // leads to the parent, not the child
  };
  struct StepSpan {
    ros::Time first, last;
    bool is_static = true;
    long version = 0;
    int changed = TfTree::kNone;
  };
  struct RecordedPart {  // records of an edge that are interpolated over a part of the time
    ros::Time first, last;
    double longest_gap = 0.0;
  };
  struct Summary {  // what is known of the chain up to a step, over a part of the time
    TimePart part;
    long version = 0;
    double longest_gap = 0.0;
    double gaps = 0.0;     // sum over all edges, without those stamped like the moving edge before them
    RecordedPart moved{};  // of the last edge that moves
    int problem_edge = TfTree::kNone;
    const char* problem = nullptr;
  };
  struct Chain {
    int step = -1;  // the last one; -1 for the fixed frame
    std::string problem;
  };

  void findChain(const TfTree& tree, int fixed_frame, const std::string& frame, Chain& chain);
  int stepTo(int frame, const Step& step);
  const Summary& summarise(const TfTree& tree, int step, const TimePart& part);

  std::vector<std::string> frames_;
  std::vector<std::size_t> first_of_;  // per frame: index of the first one of the same name
  long topology_ = -1;
  bool depends_on_all_ = false;  // the chains depend on frames that are not followed
  std::vector<Step> steps_;      // each after the one before it
  std::vector<Chain> chains_;    // per frame

  std::vector<int> steps_to_;  // per frame of the tree: index of the step that leads to it; -1 if there is none
  std::vector<int> up_, down_, above_;
  std::vector<StepSpan> step_spans_;
  std::vector<TimePart> step_parts_;
  std::vector<Summary> summaries_;  // per step: result for the part that was queried last
};

}  // namespace sdf_ccd
