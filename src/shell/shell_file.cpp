#include "shell/point_shell.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "common/files/checked_file.h"
#include "common/files/view.h"

namespace sdf_ccd {
namespace {

constexpr char kKind[] = "shell";
constexpr std::uint32_t kVersion = 7;

/// What is written once per shell.
struct ShellNumbers {
  double covering_radius, edge_radius, flatness, position_error;
  double origin[3];
};

static_assert(sizeof(ShellNumbers) == 7 * sizeof(double) && sizeof(Vector3f) == 3 * sizeof(float) &&
                  sizeof(PackedNormal) == 2 * sizeof(std::int16_t),
              "written as numbers");

/// The numbers of a shell, where they are. Every normal is valid.
struct ShellView {
  ShellNumbers numbers;
  View<Vector3f> offsets;
  View<PackedNormal> normals;
  View<float> areas;

  Vector3d origin() const { return Vector3d(numbers.origin[0], numbers.origin[1], numbers.origin[2]); }
};

ShellView viewOfShell(const PointShell& shell) {
  const Vector3d& o = shell.origin;
  return {{shell.covering_radius, shell.edge_radius, shell.flatness, shell.position_error, {o.x(), o.y(), o.z()}},
          viewOf(shell.offsets),
          viewOf(shell.normals),
          viewOf(shell.areas)};
}

/// The index of the first point with an invalid location or area; the number of points if all are valid.
std::size_t firstBad(const ShellView& shell) {
  constexpr double kFarthest = 1e15;  // [m]: squares of distances, and volumes, stay finite
  for (std::size_t i = 0; i < shell.offsets.size; ++i) {
    const Vector3d p = shell.origin() + shell.offsets[i].cast<double>();
    const bool good = (p.array().abs() < kFarthest).all() && shell.areas[i] >= 0.0 && std::isfinite(shell.areas[i]);
    if (!good) return i;
  }
  return shell.offsets.size;
}

bool isFiniteLength(double value) {
  return value >= 0.0 && std::isfinite(value);
}

/// What is wrong with a shell; empty if it is valid.
std::string faultOf(const ShellView& shell) {
  const std::size_t points = shell.offsets.size;
  if (shell.normals.size != points || shell.areas.size != points) {
    return std::to_string(points) + " points, " + std::to_string(shell.normals.size) + " normals, " +
           std::to_string(shell.areas.size) + " areas";
  }
  const std::size_t bad = firstBad(shell);
  if (bad < points) return "point " + std::to_string(bad) + " has an invalid position or area";
  const ShellNumbers& numbers = shell.numbers;
  const bool is_valid = isFiniteLength(numbers.covering_radius) && numbers.edge_radius >= 0.0 &&
                        isFiniteLength(numbers.flatness) && isFiniteLength(numbers.position_error) &&
                        shell.origin().allFinite();
  return is_valid ? "" : "its covering radius, edge radius, flatness, position error or origin is not valid";
}

}  // namespace

void saveShell(const PointShell& shell, const std::string& path, const std::string& key) {
  const ShellView view = viewOfShell(shell);
  const std::string fault = faultOf(view);
  if (!fault.empty()) throw std::runtime_error(path + ": not saved: " + fault);
  writeCheckedFile(
      path, {kKind, kVersion, key},
      {{&view.numbers, sizeof view.numbers}, sectionOf(view.offsets), sectionOf(view.normals), sectionOf(view.areas)});
}

PointShell loadShell(const std::string& path, const std::string& key) {
  const std::shared_ptr<const CheckedFile> file = CheckedFile::open(path, {kKind, kVersion, key});
  std::size_t count = 0;
  ShellView view;
  const auto* numbers = file->section<ShellNumbers>(0, count);
  view.offsets.data = file->section<Vector3f>(1, view.offsets.size);
  view.normals.data = file->section<PackedNormal>(2, view.normals.size);
  view.areas.data = file->section<float>(3, view.areas.size);
  if (count != 1) throw std::runtime_error(path + ": damaged: " + std::to_string(count) + " sets of radii, not 1");
  view.numbers = *numbers;
  const std::string fault = faultOf(view);
  if (!fault.empty()) throw std::runtime_error(path + ": damaged: " + fault);
  PointShell shell;
  shell.origin = view.origin();
  shell.offsets.assign(view.offsets.data, view.offsets.data + view.offsets.size);
  shell.normals.assign(view.normals.data, view.normals.data + view.normals.size);
  shell.areas.assign(view.areas.data, view.areas.data + view.areas.size);
  shell.covering_radius = numbers->covering_radius;
  shell.edge_radius = numbers->edge_radius;
  shell.flatness = numbers->flatness;
  shell.position_error = numbers->position_error;
  return shell;
}

}  // namespace sdf_ccd
