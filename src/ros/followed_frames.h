#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

namespace sdf_ccd {

/// No frame hangs on more frames than this, one on the other.
constexpr std::size_t kMostAbove = 256;

/// The frames whose transforms somebody needs: those that are wanted, and all above them.
///
/// A node that says of a frame every time that it hangs on another one does not make this grow: what has turned out to
/// be above no wanted frame is forgotten.
class FollowedFrames {
 public:
  /// Null if the frame's parent is not known.
  using ParentOf = std::function<const std::string*(const std::string& frame)>;

  /// @param wanted  none: all frames are followed.
  explicit FollowedFrames(const std::vector<std::string>& wanted);

  bool has(const std::string& frame) const { return wanted_.empty() || followed_.count(frame) > 0; }

  /// A followed frame has got this parent.
  /// @return whether frames may be followed no longer that were.
  bool addParent(const std::string& parent, const ParentOf& parent_of);

  std::size_t size() const { return followed_.size(); }

 private:
  void addWithAllAbove(const std::string& frame, const ParentOf& parent_of);

  std::vector<std::string> wanted_;
  std::unordered_set<std::string> followed_;
  std::size_t most_ = 0;  // before what is followed is found anew
};

}  // namespace sdf_ccd
