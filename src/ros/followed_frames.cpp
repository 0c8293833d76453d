#include "ros/followed_frames.h"

namespace sdf_ccd {

FollowedFrames::FollowedFrames(const std::vector<std::string>& wanted)
    : wanted_(wanted), followed_(wanted.begin(), wanted.end()), most_(2 * wanted.size() + kMostAbove) {}

bool FollowedFrames::addParent(const std::string& parent, const ParentOf& parent_of) {
  if (has(parent)) return false;
  addWithAllAbove(parent, parent_of);
  if (followed_.size() <= most_) return false;
  followed_.clear();
  for (const std::string& frame : wanted_) addWithAllAbove(frame, parent_of);
  most_ = 2 * followed_.size() + kMostAbove;  // so that this costs a constant per frame added
  return true;
}

void FollowedFrames::addWithAllAbove(const std::string& frame, const ParentOf& parent_of) {
  const std::string* above = &frame;
  for (std::size_t i = 0; above && i <= kMostAbove && followed_.insert(*above).second; ++i) above = parent_of(*above);
}

}  // namespace sdf_ccd
