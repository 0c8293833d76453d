#pragma once

#include <string>

#include "sdf_ccd/field.h"

namespace sdf_ccd::tools {

/// A plane normal to an axis of a field's frame.
struct Slice {
  int axis;       ///< 0 x, 1 y, 2 z
  double offset;  ///< [m]
};

/// Reads "z=0.1". @throws std::invalid_argument with the text if it is not of that form.
Slice parseSlice(const std::string& text);

/// Draws a slice through a field's box: blue inside, white near the surface, red outside; the surface is black (orange
/// where it is a cap over an opening), the edge of the band grey, and distances beyond the band are pale. A colour
/// scale of distances is drawn beside it, a length scale below, and the names of the axes that point right and up.
/// @return the bytes of a PNG file.
/// @throws std::invalid_argument if the plane does not meet the box.
std::string drawSlice(const DistanceField& field, const Slice& slice);

}  // namespace sdf_ccd::tools
