#include "print.h"

#include <cstdio>

#include "sdf_ccd/field/sparse_grid.h"

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
  const SparseGrid& grid = *field.grid();
  const Vector3i cells = grid.shape().cells();
  return format("%dx%dx%d cells of %.4g m, %zu of them stored, ", cells.x(), cells.y(), cells.z(), grid.shape().cell,
                grid.storedCells()) +
         format("%s, error at most %.3g m within %.3g m of the surface", megabytes(field.bytes()).c_str(),
                field.errorBound(), field.band());
}

std::string describe(const PointShell& shell) {
  return format("%zu points, no place of the surface farther than %.3g m from one", shell.size(),
                shell.covering_radius);
}

}  // namespace sdf_ccd::tools
