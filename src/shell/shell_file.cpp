#include "sdf_ccd/shell/point_shell.h"

#include <cmath>
#include <stdexcept>

#include "storage/checked_file.h"
#include "storage/view.h"

namespace sdf_ccd {
namespace {

constexpr char kKind[] = "shell";
constexpr std::uint32_t kVersion = 5;

static_assert(sizeof(Vector3d) == 3 * sizeof(double) && sizeof(Vector3f) == 3 * sizeof(float), "written as numbers");

/// The index of the first point with an invalid location, normal or area; the number of points if all are valid.
std::size_t firstBad(View<Vector3d> points, View<Vector3f> normals, View<float> areas) {
  constexpr double kFarthest = 1e15;  // [m]: squares of distances, and volumes, stay finite
  for (std::size_t i = 0; i < points.size; ++i) {
    const bool good = (points[i].array().abs() < kFarthest).all() && normals[i].squaredNorm() < 1.0F + 1e-5F &&
                      areas[i] >= 0.0 && std::isfinite(areas[i]);
    if (!good) return i;
  }
  return points.size;
}

}  // namespace

void saveShell(const PointShell& shell, const std::string& path, const std::string& key) {
  const double radii[] = {shell.covering_radius, shell.edge_radius, shell.flatness};
  writeCheckedFile(path, {kKind, kVersion, key},
                   {{radii, sizeof radii},
                    {shell.points.data(), shell.points.size() * sizeof(Vector3d)},
                    {shell.normals.data(), shell.normals.size() * sizeof(Vector3f)},
                    {shell.areas.data(), shell.areas.size() * sizeof(float)}});
}

PointShell loadShell(const std::string& path, const std::string& key) {
  const std::shared_ptr<const CheckedFile> file = CheckedFile::open(path, {kKind, kVersion, key});
  std::size_t numbers = 0, points = 0, normals = 0, areas = 0;
  const auto* radii = file->section<double>(0, numbers);
  const auto* point = file->section<Vector3d>(1, points);
  const auto* normal = file->section<Vector3f>(2, normals);
  const auto* area = file->section<float>(3, areas);
  if (numbers != 3 || normals != points || areas != points) {
    throw std::runtime_error(path + ": damaged: " + std::to_string(points) + " points, " + std::to_string(normals) +
                             " normals, " + std::to_string(areas) + " areas");
  }
  const std::size_t bad = firstBad({point, points}, {normal, normals}, {area, areas});
  if (bad < points)
    throw std::runtime_error(path + ": damaged: point " + std::to_string(bad) +
                             " has an invalid position, normal or area");
  const bool has_radii = radii[0] >= 0.0 && std::isfinite(radii[0]) && radii[1] >= 0.0 && radii[2] >= 0.0;
  if (!has_radii || !std::isfinite(radii[2])) {
    throw std::runtime_error(path + ": damaged: its covering radius, edge radius or flatness is not valid");
  }
  PointShell shell;
  shell.points.assign(point, point + points);
  shell.normals.assign(normal, normal + normals);
  shell.areas.assign(area, area + areas);
  shell.covering_radius = radii[0];
  shell.edge_radius = radii[1];
  shell.flatness = radii[2];
  return shell;
}

}  // namespace sdf_ccd
