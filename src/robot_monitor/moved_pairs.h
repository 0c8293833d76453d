#pragma once

#include <algorithm>
#include <vector>

#include "monitor/rigid_watch.h"

namespace sdf_ccd {

/// Collects the pairs that a scene leaves out as rigidly joined or in the same frame, but that a motion moves, or of
/// which it knows only one body.
class MovedPairs {
 public:
  explicit MovedPairs(const Scene& scene) : watch_(scene) { begin(); }

  void begin() { moved_.assign(watch_.pairs().size(), 0); }

  /// @param piece  of the motion.
  void add(const CycleMotion& piece) {
    watch_.find(piece, {}, moved_);
    if (piece.missing.empty()) return;
    for (std::size_t p = 0; p < moved_.size(); ++p) {
      const PlannedPair& pair = watch_.pairs()[p];
      if (piece.missing[pair.body_a].empty() != piece.missing[pair.body_b].empty()) moved_[p] = 1;
    }
  }

  bool any() const { return std::find(moved_.begin(), moved_.end(), 1) != moved_.end(); }

  std::vector<UncheckedPair> unchecked() const {
    std::vector<UncheckedPair> unchecked;
    for (std::size_t p = 0; p < moved_.size(); ++p) {
      const PlannedPair& pair = watch_.pairs()[p];
      if (moved_[p])
        unchecked.push_back(
            {pair.body_a, pair.body_b, "rigidly joined in the scene, but not certainly in this motion"});
    }
    return unchecked;
  }

 private:
  RigidWatch watch_;
  std::vector<char> moved_;  // per pair of watch_
};

}  // namespace sdf_ccd
