#pragma once

#include <string>

#include "image.h"

namespace sdf_ccd::tools {

constexpr int kGlyphHeight = 5;  ///< [pixels of the font]

/// Writes digits, signs, 'e', 'm', 'x', 'y', 'z', '=' and '.' with the upper left corner at (column, row), each pixel
/// of the font `size` pixels wide. Other characters are blanks.
void drawText(Image& image, int column, int row, const std::string& text, int size);

}  // namespace sdf_ccd::tools
