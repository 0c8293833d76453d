#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ros/tf/tf_edge.h"

namespace sdf_ccd {

/// Maximum length of the chain of frames above a frame.
constexpr std::size_t kMaxAbove = 256;

/// The frames of tf by number, each with the transforms in its parent.
///
/// The followed frames are those whose transforms are needed: the wanted frames and all above them. A node that gives a
/// frame a new parent every time does not make their number grow: frames found to be above no wanted frame are no
/// longer followed. Numbers of frames that are neither wanted, nor known, nor the parent of another one are reused.
class TfTree {
 public:
  static constexpr int kNone = -1;

  /// @param wanted  the frames to follow; empty: all frames.
  explicit TfTree(const std::vector<std::string>& wanted);

  /// kNone if the frame has no number.
  int find(std::string_view name) const;

  /// Returns the frame's number, a new one if it has none. A new frame must be wanted, or get a transform or a child
  /// soon.
  int add(std::string_view name);

  /// Also follows these frames, instead of those of the last call. No effect if all frames are followed.
  void setExtraFrames(const std::vector<std::string>& names);

  /// Keeps the frame's number, even while the frame is not used.
  void pin(int frame) { frames_[frame].is_pinned = true; }

  std::size_t size() const { return frames_.size(); }  ///< all numbers are less
  const std::string& name(int frame) const { return frames_[frame].name; }
  const TfEdge& edge(int frame) const { return frames_[frame].edge; }
  TfEdge& edge(int frame) { return frames_[frame].edge; }

  /// kNone if no transform of the frame is known.
  int parent(int frame) const { return frames_[frame].parent; }
  bool isFollowed(int frame) const { return frames_[frame].is_followed; }
  bool followsAll() const { return follows_all_; }

  /// Number of known frames that are not followed: moving or static.
  std::size_t unfollowed(bool is_static) const { return unfollowed_[is_static]; }

  /// Number of followed frames; 0 if all are.
  std::size_t followed() const { return followed_; }

  /// Sets the parent and the kind of the frame's edge, which already has a transform.
  /// @return frames that are followed since this call, or no longer are.
  const std::vector<int>& setEdge(int frame, int parent, bool is_static);

  /// Forgets the frame's transforms.
  void forget(int frame);

  /// The chain of frames from this one up that have a transform; longer than kMaxAbove if it is a loop.
  void upwards(int frame, std::vector<int>& edges) const;

  /// Root of the frame's tree: the last frame above it, or the frame itself.
  int root(int frame, const std::vector<int>& upwards) const {
    return upwards.empty() ? frame : frames_[upwards.back()].parent;
  }

  /// Another value after a followed frame, or with `of_all` any frame, has appeared, disappeared or got another parent.
  long topology(bool of_all) const { return of_all ? topology_ : followed_topology_; }

 private:
  struct Frame {
    std::string name;  // empty: the number is unused
    TfEdge edge;
    int parent = kNone;
    int children = 0;
    bool is_wanted = false, is_pinned = false, is_followed = false;
  };

  void change(int frame);
  void setFollowed(int frame, bool is_followed);
  void follow(int frame);
  void followWanted();
  void dropIfUnused(int frame);

  const bool follows_all_;
  std::deque<Frame> frames_;                           // a deque: names keep their addresses
  std::unordered_map<std::string_view, int> numbers_;  // by name
  std::vector<int> free_;
  std::vector<int> wanted_;    // those of the constructor, then those of setExtraFrames()
  std::size_t permanent_ = 0;  // number of those of the constructor
  std::size_t unfollowed_[2] = {0, 0};
  std::size_t followed_ = 0;
  std::size_t most_followed_ = 0;  // beyond it, the followed frames are determined again
  long topology_ = 0, followed_topology_ = 0;
  std::vector<int> changed_;  // result of setEdge()
};

}  // namespace sdf_ccd
