#include "slice.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "field/opening_caps.h"
#include "field/uniform/sparse_grid.h"
#include "pixel_font.h"
#include "print.h"

namespace sdf_ccd::tools {
namespace {

constexpr int kLongSide = 800;  // [pixels], as all below
constexpr int kMinSide = 200;
constexpr int kMargin = 20;
constexpr int kLegendWidth = 190;
constexpr int kFooter = 60;
constexpr int kFont = 3;

constexpr Color kCap{255, 140, 0};  ///< where the surface closes an opening of the mesh

Color mixed(const Vector3d& a, const Vector3d& b, double t) {
  const Vector3d c = a + t * (b - a);
  return {static_cast<std::uint8_t>(c.x()), static_cast<std::uint8_t>(c.y()), static_cast<std::uint8_t>(c.z())};
}

/// Blue for −band, white for 0, red for +band; beyond the band what is known is only a bound, shown paler.
Color colorOf(double distance, double band) {
  static const Vector3d kBlue(33, 102, 172), kWhite(247, 247, 247), kRed(178, 24, 43);
  const Vector3d& end = distance < 0.0 ? kBlue : kRed;
  const double share = std::min(std::abs(distance) / band, 1.0);
  return std::abs(distance) <= band ? mixed(kWhite, end, share) : mixed(kWhite, end, 0.35);
}

/// The plane cut out of the field's box, as a raster.
struct Raster {
  Vector3d corner;  ///< lower left [m]
  int right;        ///< axis of the columns
  int up;           ///< axis of the rows
  double pixel;     ///< [m]
  int width;
  int height;

  Vector3d at(double column, double row) const {
    Vector3d p = corner;
    p[right] += pixel * column;
    p[up] += pixel * (height - row);
    return p;
  }
};

Raster rasterOf(const DistanceField& field, const Slice& slice) {
  const AlignedBox3d box = field.box();
  if (!(slice.place >= box.min()[slice.axis] && slice.place <= box.max()[slice.axis])) {
    throw std::invalid_argument("the slice at " + shortly(slice.place) + " m misses the field's box, " + describe(box));
  }
  Raster raster;
  raster.corner = box.min();
  raster.corner[slice.axis] = slice.place;
  raster.right = slice.axis == 0 ? 1 : 0;
  raster.up = slice.axis == 2 ? 1 : 2;
  const Vector3d size = box.sizes();
  raster.pixel = std::max(size[raster.right], size[raster.up]) / kLongSide;
  raster.width = std::max(kMinSide, static_cast<int>(size[raster.right] / raster.pixel));
  raster.height = std::max(kMinSide, static_cast<int>(size[raster.up] / raster.pixel));
  return raster;
}

/// True where the value passes `level` between this pixel's corner and the next ones'.
bool crosses(const std::vector<double>& corners, int stride, std::size_t i, double level) {
  const double v[4] = {corners[i], corners[i + 1], corners[i + stride], corners[i + stride + 1]};
  return (*std::min_element(v, v + 4) <= level) && (*std::max_element(v, v + 4) > level);
}

void drawField(Image& image, const DistanceField& field, const Raster& raster) {
  const int stride = raster.width + 1;
  std::vector<double> corners(std::size_t(stride) * (raster.height + 1));
  for (int y = 0; y <= raster.height; ++y) {
    for (int x = 0; x <= raster.width; ++x) {
      corners[std::size_t(y) * stride + x] = field.interpolate(raster.at(x, y)).value;
    }
  }
  const double band = field.band();
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const std::size_t i = std::size_t(y) * stride + x;
      image.set(kMargin + x, kMargin + y, colorOf(corners[i], band));
      if (crosses(corners, stride, i, band) || crosses(corners, stride, i, -band)) {
        image.set(kMargin + x, kMargin + y, Color{120, 120, 120});
      }
    }
  }
  const OpeningCaps* caps = field.openings();
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      if (!crosses(corners, stride, std::size_t(y) * stride + x, 0.0)) continue;
      const bool is_cap = caps && caps->isWithin(raster.at(x, y), field.errorBound() + 2.0 * raster.pixel);
      for (const int dx : {0, 1}) {
        for (const int dy : {0, 1}) image.set(kMargin + x + dx, kMargin + y + dy, is_cap ? kCap : Color{0, 0, 0});
      }
    }
  }
}

void drawLegend(Image& image, const DistanceField& field, const Raster& raster) {
  const int left = 2 * kMargin + raster.width;
  const double band = field.band();
  const double top = 1.25 * band;  // the pale ends show what lies beyond the band
  const auto rowOf = [&](double distance) {
    return kMargin + static_cast<int>((1.0 - (distance + top) / (2.0 * top)) * (raster.height - 1));
  };
  for (int y = 0; y < raster.height; ++y) {
    const double distance = top * (1.0 - 2.0 * y / (raster.height - 1));
    for (int x = 0; x < kMargin; ++x) image.set(left + x, kMargin + y, colorOf(distance, band));
  }
  for (const double distance : {-band, -band / 2, 0.0, band / 2, band}) {
    const int row = rowOf(distance);
    const bool is_surface = distance == 0.0;
    const bool is_edge = std::abs(distance) == band;
    for (int x = is_surface || is_edge ? 0 : kMargin; x < kMargin + 6; ++x) {
      image.set(left + x, row, is_edge ? Color{120, 120, 120} : Color{0, 0, 0});
      if (is_surface) image.set(left + x, row + 1, Color{0, 0, 0});
    }
    const std::string label = (distance > 0.0 ? "+" : "") + shortly(distance) + " m";
    drawText(image, left + kMargin + 12, row - kFont * kGlyphHeight / 2, label, kFont);
  }
}

/// The axes' names: of the columns below the right end, of the rows beside the upper end.
void drawAxisNames(Image& image, const Raster& raster) {
  const int letter = 3 * kFont;
  drawText(image, kMargin + raster.width - letter, kMargin + raster.height + 4, std::string(1, "xyz"[raster.right]),
           kFont);
  drawText(image, (kMargin - letter) / 2, kMargin, std::string(1, "xyz"[raster.up]), kFont);
}

void drawLengthScale(Image& image, const Raster& raster, const Slice& slice) {
  // 1, 2 or 5 times a power of ten, at most a third of the picture.
  const double longest = raster.pixel * raster.width / 3.0;
  double length = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * length <= longest) {
      length *= factor;
      break;
    }
  }
  const int row = kMargin + raster.height + kMargin / 2;
  const int pixels = static_cast<int>(length / raster.pixel);
  for (int x = 0; x <= pixels; ++x) {
    const int half = x == 0 || x == pixels ? 4 : 1;
    for (int y = -half; y <= half; ++y) image.set(kMargin + x, row + y, Color{0, 0, 0});
  }
  const std::string plane = std::string(1, "xyz"[slice.axis]) + "=" + shortly(slice.place) + " m";
  drawText(image, kMargin, row + 10, shortly(length) + " m  " + plane, kFont);
}

}  // namespace

Slice parseSlice(const std::string& text) {
  const bool has_axis = text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=';
  char* end = nullptr;
  const double place = has_axis ? std::strtod(text.c_str() + 2, &end) : 0.0;
  if (!has_axis || end == text.c_str() + 2 || *end != '\0' || !std::isfinite(place)) {
    throw std::invalid_argument("--slice \"" + text + "\" is not of the form x=0.1, y=0.1 or z=0.1");
  }
  return {text[0] - 'x', place};
}

Image drawSlice(const DistanceField& field, const Slice& slice) {
  const Raster raster = rasterOf(field, slice);
  Image image(raster.width + 2 * kMargin + kLegendWidth, raster.height + kMargin + kFooter);
  drawField(image, field, raster);
  drawLegend(image, field, raster);
  drawAxisNames(image, raster);
  drawLengthScale(image, raster, slice);
  return image;
}

}  // namespace sdf_ccd::tools
