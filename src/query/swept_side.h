#pragma once

#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// The side of the surface on which the whole segment surely is.
enum class SweptSide { kOutside, kInside, kUnknown };

/// Conservative, as mayTouch(). kInside is found by one sphere about the middle only, as for segments that are short
/// compared with the body.
/// @param margin  from the surface, which the true distance exceeds all along on either side [m].
SweptSide sweptSide(const DistanceField& field, const Segment& segment, double margin);

}  // namespace sdf_ccd
