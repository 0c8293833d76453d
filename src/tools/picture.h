#pragma once

#include <memory>
#include <string>

#include <cairo.h>

#include "sdf_ccd/types.h"

namespace sdf_ccd::tools {

using Color = Vector3d;  ///< red, green, blue, 0 to 255

constexpr double kFontSize = 15.0;  // [pixels]

/// A white picture to draw rectangles and texts on; all lengths are in pixels.
class Picture {
 public:
  Picture(int width, int height);

  void fill(const cairo_rectangle_int_t& area, const Color& color);

  /// Draws a black text from (x, y), the start of its baseline.
  void write(int x, int y, const std::string& text);

  /// The bytes of a PNG file.
  std::string png() const;

 private:
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  };

  void setColor(const Color& color);

  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> cairo_;
};

}  // namespace sdf_ccd::tools
