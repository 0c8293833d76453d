#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// Two links that overlap, or may, while all joints are at rest: at zero, or at the nearest limit.
struct RestOverlap {
  enum class Kind {
    kOverlap,   ///< their shapes overlap
    kTouching,  ///< neighbours whose surfaces come within 1 mm
    kOpen       ///< as far as can be told: surfaces coincide or nearly so, or the inside of one is not known
  };
  std::string link_a, link_b;
  Kind kind = Kind::kOverlap;
  double depth = 0.0;         ///< of the deepest point found [m]; 0 if only the surfaces show the overlap
  bool is_always = false;     ///< they overlap or touch also in all random states that were tested
  bool is_set_aside = false;  ///< left out of the scene: their contacts are not seen
  bool is_requested = false;  ///< checked because the user named the pair
};

/// Those of the pairs that are set aside, as "3 pairs that overlap at rest are set aside: wheel - base (30 mm), ..."
/// for the user, the deepest first, with the lines of an SRDF that make it permanent; empty if there is none.
std::string setAsideText(const std::vector<RestOverlap>& pairs);

/// The same of those that are checked, with the lines that would set them aside.
std::string checkedOverlapsText(const std::vector<RestOverlap>& pairs);

/// The overlaps as they are in another version of their scene: requests may have set pairs aside for other reasons, or
/// have them checked.
std::vector<RestOverlap> overlapsIn(const Scene& scene, const std::vector<RestOverlap>& pairs);

}  // namespace sdf_ccd
