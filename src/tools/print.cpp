#include "print.h"

#include <algorithm>
#include <cstdio>

#include "field/adaptive_grid.h"
#include "field/opening_caps.h"
#include "field/sparse_grid.h"

namespace sdf_ccd::tools {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string describe(const Vector3d& p) {
  return format("%.6g %.6g %.6g", p.x(), p.y(), p.z());
}

}  // namespace

std::string rounded(double value, int decimals) {
  return format("%.*f", decimals, value);
}

std::string shortly(double value) {
  return format("%.3g", value);
}

std::string megabytes(std::size_t bytes) {
  return format("%.1f MB", static_cast<double>(bytes) / 1e6);
}

std::string describe(const AlignedBox3d& box) {
  return describe(box.min()) + " .. " + describe(box.max()) + " m";
}

std::string describe(const DistanceField& field) {
  const std::string accuracy = format("%s, error at most %.3g m within %.3g m of the surface",
                                      megabytes(field.bytes()).c_str(), field.errorBound(), field.band());
  if (const AdaptiveGrid* adaptive = field.adaptive()) {
    const Vector3i size = adaptive->shape().size;
    return format("%d×%d×%d cells of %.4g m, divided into %zu where needed, ", size.x(), size.y(), size.z(),
                  adaptive->shape().cell, field.cells()) +
           accuracy;
  }
  const Vector3i cells = field.grid()->shape().cells();
  return format("%d×%d×%d cells of %.4g m, %zu of them stored, %d bits a sample, ", cells.x(), cells.y(), cells.z(),
                field.grid()->shape().cell, field.cells(), field.grid()->sampleBits()) +
         accuracy;
}

std::string describeOpenings(const DistanceField& field) {
  const OpeningCaps* caps = field.openings();
  if (!caps) return "none";
  const double reach = *std::max_element(caps->reach().begin(), caps->reach().end());
  return format("caps of %.3g m^2 that reach up to %.3g m from the mesh: what they bound may be inside or not",
                surfaceArea(caps->mesh()), reach);
}

std::string describe(const PointShell& shell) {
  return format("%zu points, no place of the surface farther than %.3g m from one", shell.size(),
                shell.covering_radius);
}

}  // namespace sdf_ccd::tools
