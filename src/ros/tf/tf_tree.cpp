#include "ros/tf/tf_tree.h"

namespace sdf_ccd {

TfTree::TfTree(const std::vector<std::string>& wanted)
    : follows_all_(wanted.empty()), most_followed_(2 * wanted.size() + kMaxAbove) {
  for (const std::string& name : wanted) {
    const int frame = add(name);
    if (frames_[frame].is_wanted) continue;
    frames_[frame].is_wanted = true;
    wanted_.push_back(frame);
    setFollowed(frame, true);
  }
  permanent_ = wanted_.size();
}

void TfTree::setExtraFrames(const std::vector<std::string>& names) {
  if (follows_all_) return;
  const std::vector<int> before(wanted_.begin() + static_cast<std::ptrdiff_t>(permanent_), wanted_.end());
  wanted_.resize(permanent_);
  for (const int frame : before) frames_[frame].is_wanted = false;
  for (const std::string& name : names) {
    const int frame = add(name);
    if (frames_[frame].is_wanted) continue;
    frames_[frame].is_wanted = true;
    wanted_.push_back(frame);
  }
  for (const int frame : before) dropIfUnused(frame);
  ++followed_topology_;  // a name without a number may have one now
  followWanted();
}

int TfTree::find(std::string_view name) const {
  const auto found = numbers_.find(name);
  return found == numbers_.end() ? kNone : found->second;
}

int TfTree::add(std::string_view name) {
  const int known = find(name);
  if (known != kNone) return known;
  int frame = static_cast<int>(frames_.size());
  if (free_.empty()) {
    frames_.emplace_back();
  } else {
    frame = free_.back();
    free_.pop_back();
  }
  frames_[frame].name = name;
  frames_[frame].is_followed = follows_all_;
  numbers_.emplace(frames_[frame].name, frame);
  return frame;
}

const std::vector<int>& TfTree::setEdge(int frame, int parent, bool is_static) {
  Frame& f = frames_[frame];
  const int old_parent = f.parent;
  if (!f.is_followed) {
    if (old_parent != kNone) --unfollowed_[f.edge.is_static];
    ++unfollowed_[is_static];
  }
  f.edge.is_static = is_static;
  changed_.clear();
  if (old_parent != parent) {
    f.parent = parent;
    ++frames_[parent].children;
    if (f.is_followed) follow(parent);
    if (old_parent != kNone) {
      --frames_[old_parent].children;
      dropIfUnused(old_parent);
    }
  }
  change(frame);
  return changed_;
}

void TfTree::forget(int frame) {
  Frame& f = frames_[frame];
  if (f.parent == kNone) return;
  if (!f.is_followed) --unfollowed_[f.edge.is_static];
  const int parent = f.parent;
  f.edge = {};
  f.parent = kNone;
  --frames_[parent].children;
  change(frame);
  dropIfUnused(parent);
  dropIfUnused(frame);
}

void TfTree::upwards(int frame, std::vector<int>& edges) const {
  edges.clear();
  for (; frames_[frame].parent != kNone && edges.size() <= kMaxAbove; frame = frames_[frame].parent) {
    edges.push_back(frame);
  }
}

void TfTree::change(int frame) {
  ++topology_;
  if (frames_[frame].is_followed) ++followed_topology_;
}

void TfTree::setFollowed(int frame, bool is_followed) {
  Frame& f = frames_[frame];
  if (follows_all_ || f.is_followed == is_followed) return;
  f.is_followed = is_followed;
  is_followed ? ++followed_ : --followed_;
  if (f.parent == kNone) return;
  is_followed ? --unfollowed_[f.edge.is_static] : ++unfollowed_[f.edge.is_static];
  ++followed_topology_;
  changed_.push_back(frame);
}

/// Follows the frame and all frames above it.
void TfTree::follow(int frame) {
  if (follows_all_ || frames_[frame].is_followed) return;
  for (std::size_t i = 0; frame != kNone && i <= kMaxAbove && !frames_[frame].is_followed; ++i) {
    setFollowed(frame, true);
    frame = frames_[frame].parent;
  }
  if (followed_ > most_followed_) followWanted();
}

/// Determines the followed frames again; amortised, a constant cost per followed frame.
void TfTree::followWanted() {
  std::vector<char> is_above(frames_.size(), 0);
  std::size_t count = 0;
  for (int frame : wanted_) {
    for (std::size_t i = 0; frame != kNone && i <= kMaxAbove && !is_above[frame]; ++i) {
      is_above[frame] = 1;
      ++count;
      frame = frames_[frame].parent;
    }
  }
  for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
    if (!frames_[frame].name.empty()) setFollowed(static_cast<int>(frame), is_above[frame]);
  }
  most_followed_ = 2 * count + kMaxAbove;
}

void TfTree::dropIfUnused(int frame) {
  Frame& f = frames_[frame];
  if (f.parent != kNone || f.children > 0 || f.is_wanted || f.is_pinned || f.name.empty()) return;
  setFollowed(frame, false);
  numbers_.erase(f.name);
  f = {};
  free_.push_back(frame);
}

}  // namespace sdf_ccd
