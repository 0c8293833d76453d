#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ros/tf/tf_edge.h"

namespace sdf_ccd {

/// No frame hangs on more frames than this, one on the other.
constexpr std::size_t kMostAbove = 256;

/// The frames of tf by number, each with the transforms in its parent.
///
/// Frames are followed whose transforms somebody needs: those that are wanted, and all above them. A node that says of
/// a frame every time that it hangs on another one does not make these grow: what has turned out to be above no wanted
/// frame is forgotten. Numbers of frames that are neither wanted, nor known, nor anybody's parent are given again.
class TfTree {
 public:
  static constexpr int kNone = -1;

  /// @param wanted  none: all frames are followed.
  explicit TfTree(const std::vector<std::string>& wanted);

  /// kNone if the frame has no number.
  int find(std::string_view name) const;

  /// Gives it one. It is wanted, or has to get a transform or a child soon.
  int add(std::string_view name);

  /// Follows these frames too, and no longer those that the last call named; for trees that do not follow all.
  void wantBesides(const std::vector<std::string>& names);

  /// Keeps the frame's number, whatever comes.
  void pin(int frame) { frames_[frame].is_pinned = true; }

  std::size_t size() const { return frames_.size(); }  ///< all numbers are less
  const std::string& name(int frame) const { return frames_[frame].name; }
  const TfEdge& edge(int frame) const { return frames_[frame].edge; }
  TfEdge& edge(int frame) { return frames_[frame].edge; }

  /// kNone if no transform of the frame is known.
  int parent(int frame) const { return frames_[frame].parent; }
  bool isFollowed(int frame) const { return frames_[frame].is_followed; }
  bool followsAll() const { return follows_all_; }

  /// Of those that are not followed and known: moving ones, static ones.
  std::size_t others(bool is_static) const { return others_[is_static]; }

  /// Of those that are followed; 0 if all are.
  std::size_t followed() const { return followed_; }

  /// The edge, which has a transform, is this one now.
  /// @return frames that have come to be followed, or no longer are.
  const std::vector<int>& setEdge(int frame, int parent, bool is_static);

  /// Forgets the frame's transforms.
  void forget(int frame);

  /// The frames from this one up, as many as have a transform; more than kMostAbove if they are a loop.
  void upwards(int frame, std::vector<int>& edges) const;

  /// The last that is above the frame, or it itself.
  int root(int frame, const std::vector<int>& upwards) const {
    return upwards.empty() ? frame : frames_[upwards.back()].parent;
  }

  /// Another one after a frame that is followed, or any frame, has come, gone, or got another parent.
  long topology(bool of_all) const { return of_all ? topology_ : followed_topology_; }

 private:
  struct Frame {
    std::string name;  // empty: the number is free
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
  std::deque<Frame> frames_;                           // whose names stay where they are
  std::unordered_map<std::string_view, int> numbers_;  // by name
  std::vector<int> free_;
  std::vector<int> wanted_;                            // those from the beginning, then those besides
  std::size_t from_the_beginning_ = 0;
  std::size_t others_[2] = {0, 0};
  std::size_t followed_ = 0;
  std::size_t most_followed_ = 0;  // before what is followed is found anew
  long topology_ = 0, followed_topology_ = 0;
  std::vector<int> turned_;  // what setEdge() tells
};

}  // namespace sdf_ccd
