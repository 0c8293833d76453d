#include "sdf_ccd/shell/point_shell.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "storage/checked_file.h"
#include "storage/view.h"

namespace sdf_ccd {
namespace {

constexpr char kKind[] = "shell";
constexpr std::uint32_t kVersion = 6;

static_assert(sizeof(Vector3d) == 3 * sizeof(double) && sizeof(Vector3f) == 3 * sizeof(float), "written as numbers");

/// The numbers of a shell, where they are.
struct ShellView {
  View<Vector3d> points;
  View<Vector3f> normals;
  View<float> areas;
  double covering_radius, edge_radius, flatness;
};

/// The index of the first point with an invalid location, normal or area; the number of points if all are valid.
std::size_t firstBad(const ShellView& shell) {
  constexpr double kFarthest = 1e15;  // [m]: squares of distances, and volumes, stay finite
  for (std::size_t i = 0; i < shell.points.size; ++i) {
    const bool good = (shell.points[i].array().abs() < kFarthest).all() &&
                      shell.normals[i].squaredNorm() < 1.0F + 1e-5F && shell.areas[i] >= 0.0 &&
                      std::isfinite(shell.areas[i]);
    if (!good) return i;
  }
  return shell.points.size;
}

/// What is wrong with a shell; empty if it is valid.
std::string faultOf(const ShellView& shell) {
  const std::size_t points = shell.points.size;
  if (shell.normals.size != points || shell.areas.size != points) {
    return std::to_string(points) + " points, " + std::to_string(shell.normals.size) + " normals, " +
           std::to_string(shell.areas.size) + " areas";
  }
  const std::size_t bad = firstBad(shell);
  if (bad < points) return "point " + std::to_string(bad) + " has an invalid position, normal or area";
  const bool has_radii = shell.covering_radius >= 0.0 && std::isfinite(shell.covering_radius) &&
                         shell.edge_radius >= 0.0 && shell.flatness >= 0.0 && std::isfinite(shell.flatness);
  return has_radii ? "" : "its covering radius, edge radius or flatness is not valid";
}

}  // namespace

void saveShell(const PointShell& shell, const std::string& path, const std::string& key) {
  const std::string fault = faultOf({viewOf(shell.points), viewOf(shell.normals), viewOf(shell.areas),
                                     shell.covering_radius, shell.edge_radius, shell.flatness});
  if (!fault.empty()) throw std::runtime_error(path + ": not saved: " + fault);
  const double radii[] = {shell.covering_radius, shell.edge_radius, shell.flatness};
  writeCheckedFile(path, {kKind, kVersion, key},
                   {{radii, sizeof radii},
                    sectionOf(viewOf(shell.points)),
                    sectionOf(viewOf(shell.normals)),
                    sectionOf(viewOf(shell.areas))});
}

PointShell loadShell(const std::string& path, const std::string& key) {
  const std::shared_ptr<const CheckedFile> file = CheckedFile::open(path, {kKind, kVersion, key});
  std::size_t numbers = 0, points = 0, normals = 0, areas = 0;
  const auto* radii = file->section<double>(0, numbers);
  const auto* point = file->section<Vector3d>(1, points);
  const auto* normal = file->section<Vector3f>(2, normals);
  const auto* area = file->section<float>(3, areas);
  if (numbers != 3) throw std::runtime_error(path + ": damaged: " + std::to_string(numbers) + " radii, not 3");
  const std::string fault = faultOf({{point, points}, {normal, normals}, {area, areas}, radii[0], radii[1], radii[2]});
  if (!fault.empty()) throw std::runtime_error(path + ": damaged: " + fault);
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
