#include "picture.h"

#include <stdexcept>

namespace sdf_ccd::tools {

Picture::Picture(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), cairo_(cairo_create(surface_.get())) {
  cairo_set_antialias(cairo_.get(), CAIRO_ANTIALIAS_NONE);
  cairo_select_font_face(cairo_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_.get(), kFontSize);
  fill({0, 0, width, height}, Color(255, 255, 255));
}

void Picture::fill(const cairo_rectangle_int_t& area, const Color& color) {
  setColor(color);
  cairo_rectangle(cairo_.get(), area.x, area.y, area.width, area.height);
  cairo_fill(cairo_.get());
}

void Picture::write(int x, int y, const std::string& text) {
  setColor(Color(0, 0, 0));
  cairo_move_to(cairo_.get(), x, y);
  cairo_show_text(cairo_.get(), text.c_str());
}

std::string Picture::png() const {
  std::string bytes;
  const auto append = [](void* to, const unsigned char* from, unsigned count) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(from), count);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface_.get(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(std::string("cairo: ") + cairo_status_to_string(status));
  return bytes;
}

void Picture::setColor(const Color& color) {
  cairo_set_source_rgb(cairo_.get(), color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

}  // namespace sdf_ccd::tools
