#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

namespace sdf_ccd::tools {

struct Color {
  std::uint8_t red;
  std::uint8_t green;
  std::uint8_t blue;
};

/// Pixels, row by row from the top, white at first.
class Image {
 public:
  Image(int width, int height)
      : width_(width), height_(height), pixels_(std::size_t(width) * height, {255, 255, 255}) {}

  int width() const { return width_; }
  int height() const { return height_; }
  const Color* row(int y) const { return &pixels_[std::size_t(y) * width_]; }

  /// Pixels outside are passed over.
  void set(int x, int y, Color color) {
    if (x >= 0 && y >= 0 && x < width_ && y < height_) pixels_[std::size_t(y) * width_ + x] = color;
  }

 private:
  int width_;
  int height_;
  std::vector<Color> pixels_;
};

/// @throws std::runtime_error if libpng fails.
void writePng(const Image& image, std::ostream& stream);

}  // namespace sdf_ccd::tools
