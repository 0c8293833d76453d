#include "image.h"

#include <png.h>

#include <ostream>
#include <stdexcept>
#include <string>

namespace sdf_ccd::tools {

static_assert(sizeof(Color) == 3, "rows go to libpng as they are");

void writePng(const Image& image, std::ostream& stream) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width());
  png.height = static_cast<png_uint_32>(image.height());
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<char> buffer(bytes);
  if (!png_image_write_to_memory(&png, buffer.data(), &bytes, 0, image.row(0), 0, nullptr)) {
    throw std::runtime_error("libpng: " + std::string(png.message));
  }
  stream.write(buffer.data(), static_cast<std::streamsize>(bytes));
}

}  // namespace sdf_ccd::tools
