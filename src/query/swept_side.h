#pragma once

#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// The side of the surface on which the whole segment surely is.
enum class SweptSide { kOutside, kInside, kUnknown };

/// How far from the surface a segment must stay to be on one side of it.
struct SweptMargins {
  double outside;  ///< outside: the true distance exceeds this [m]
  double inside;   ///< inside: it is below minus this [m]
};

/// Conservative, as mayTouch(). kInside is found by one sphere about the middle only, as for segments that are short
/// compared with the body.
SweptSide sweptSide(const DistanceField& field, const Segment& segment, const SweptMargins& margins);

}  // namespace sdf_ccd
