#include "slice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "common/number_text.h"
#include "common/read_number.h"
#include "field/field_access.h"
#include "field/opening_caps.h"
#include "picture.h"
#include "print.h"

namespace sdf_ccd::tools {
namespace {

constexpr int kLongSide = 800;  // [pixels], as all below
constexpr int kMinSide = 200;
constexpr int kMargin = 20;
constexpr int kLegendWidth = 190;
constexpr int kFooter = 60;

const Color kBlack(0, 0, 0), kGrey(120, 120, 120);
const Color kCap(255, 140, 0);  // where the surface closes an opening of the mesh

/// Blue at −band, white at 0, red at +band. Paler beyond the band, where only a bound of the distance is known.
Color colorOf(double distance, double band) {
  static const Color kBlue(33, 102, 172), kWhite(247, 247, 247), kRed(178, 24, 43);
  const double share = std::abs(distance) <= band ? std::abs(distance) / band : 0.35;
  return kWhite + share * ((distance < 0.0 ? kBlue : kRed) - kWhite);
}

/// The slice of the field's box, as a raster.
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
  if (!(slice.offset >= box.min()[slice.axis] && slice.offset <= box.max()[slice.axis])) {
    throw std::invalid_argument("the slice at " + shortText(slice.offset) + " m misses the field's box, " +
                                describe(box));
  }
  Raster raster;
  raster.corner = box.min();
  raster.corner[slice.axis] = slice.offset;
  raster.right = slice.axis == 0 ? 1 : 0;
  raster.up = slice.axis == 2 ? 1 : 2;
  const Vector3d size = box.sizes();
  raster.pixel = std::max(size[raster.right], size[raster.up]) / kLongSide;
  raster.width = std::max(kMinSide, static_cast<int>(size[raster.right] / raster.pixel));
  raster.height = std::max(kMinSide, static_cast<int>(size[raster.up] / raster.pixel));
  return raster;
}

/// True if the values at the four corners of pixel `i` lie on both sides of `level`.
bool crosses(const std::vector<double>& corners, int stride, std::size_t i, double level) {
  const double v[4] = {corners[i], corners[i + 1], corners[i + stride], corners[i + stride + 1]};
  return (*std::min_element(v, v + 4) <= level) && (*std::max_element(v, v + 4) > level);
}

void drawField(Picture& picture, const DistanceField& field, const Raster& raster) {
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
      const bool is_edge = crosses(corners, stride, i, band) || crosses(corners, stride, i, -band);
      picture.fill({kMargin + x, kMargin + y, 1, 1}, is_edge ? kGrey : colorOf(corners[i], band));
    }
  }
  const OpeningCaps* caps = FieldAccess::openings(field);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      if (!crosses(corners, stride, std::size_t(y) * stride + x, 0.0)) continue;
      const bool is_cap = caps && caps->isWithin(raster.at(x, y), field.errorBound() + 2.0 * raster.pixel);
      picture.fill({kMargin + x, kMargin + y, 2, 2}, is_cap ? kCap : kBlack);
    }
  }
}

void drawLegend(Picture& picture, const DistanceField& field, const Raster& raster) {
  const int left = 2 * kMargin + raster.width;
  const double band = field.band();
  const double top = 1.25 * band;  // the pale ends stand for distances beyond the band
  for (int y = 0; y < raster.height; ++y) {
    const double distance = top * (1.0 - 2.0 * y / (raster.height - 1));
    picture.fill({left, kMargin + y, kMargin, 1}, colorOf(distance, band));
  }
  for (const double distance : {-band, -band / 2, 0.0, band / 2, band}) {
    const int row = kMargin + static_cast<int>((1.0 - (distance + top) / (2.0 * top)) * (raster.height - 1));
    const bool is_surface = distance == 0.0, is_edge = std::abs(distance) == band;
    const int begin = is_surface || is_edge ? 0 : kMargin;
    picture.fill({left + begin, row, kMargin + 6 - begin, is_surface ? 2 : 1}, is_edge ? kGrey : kBlack);
    const std::string label = (distance > 0.0 ? "+" : "") + shortText(distance) + " m";
    picture.write(left + kMargin + 12, row + static_cast<int>(0.35 * kFontSize), label);
  }
}

/// Draws the names of the axes: the horizontal one below the right end, the vertical one beside the upper end.
void drawAxisNames(Picture& picture, const Raster& raster) {
  const int letter = static_cast<int>(0.6 * kFontSize), height = static_cast<int>(0.7 * kFontSize);
  picture.write(kMargin + raster.width - letter, kMargin + raster.height + 4 + height,
                std::string(1, "xyz"[raster.right]));
  picture.write((kMargin - letter) / 2, kMargin + height, std::string(1, "xyz"[raster.up]));
}

void drawLengthScale(Picture& picture, const Raster& raster, const Slice& slice) {
  // 1, 2 or 5 times a power of ten, at most a third of the raster's width.
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
  picture.fill({kMargin, row - 1, pixels, 3}, kBlack);
  for (const int end : {0, pixels}) picture.fill({kMargin + end, row - 4, 1, 9}, kBlack);
  const std::string plane = std::string(1, "xyz"[slice.axis]) + "=" + shortText(slice.offset) + " m";
  picture.write(kMargin, row + 10 + static_cast<int>(kFontSize), shortText(length) + " m  " + plane);
}

}  // namespace

Slice parseSlice(const std::string& text) {
  const bool has_axis = text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=';
  const std::optional<double> offset = has_axis ? wholeNumber(text.substr(2)) : std::nullopt;
  if (!offset || !std::isfinite(*offset)) {
    throw std::invalid_argument("--slice \"" + text + "\" is not of the form x=0.1, y=0.1 or z=0.1");
  }
  return {text[0] - 'x', *offset};
}

std::string drawSlice(const DistanceField& field, const Slice& slice) {
  const Raster raster = rasterOf(field, slice);
  Picture picture(raster.width + 2 * kMargin + kLegendWidth, raster.height + kMargin + kFooter);
  drawField(picture, field, raster);
  drawLegend(picture, field, raster);
  drawAxisNames(picture, raster);
  drawLengthScale(picture, raster, slice);
  return picture.png();
}

}  // namespace sdf_ccd::tools
