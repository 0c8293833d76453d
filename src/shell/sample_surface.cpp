#include "sdf_ccd/shell/sample_surface.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "measure_shell.h"
#include "surface_filler.h"

namespace sdf_ccd {
namespace {

void validate(const ShellOptions& options) {
  std::ostringstream message;
  if (!(options.spacing > 0) || !std::isfinite(options.spacing)) {
    message << "a shell's spacing must be finite and positive, not " << options.spacing << " m";
  } else if (!(options.vertex_spacing >= 0) || !std::isfinite(options.vertex_spacing)) {
    message << "a shell's vertex spacing must be finite and not negative, not " << options.vertex_spacing << " m";
  } else {
    return;
  }
  throw std::invalid_argument(message.str());
}

/// Balls of radius `spacing` cover at most their disks' area on a plane, so fewer points than this cannot do.
void requireRoom(double area, const ShellOptions& options) {
  constexpr double kPi = 3.14159265358979323846;
  const double least = area / (kPi * options.spacing * options.spacing);
  if (least <= static_cast<double>(options.max_points)) return;
  std::ostringstream message;
  message << "a point every " << options.spacing << " m on " << area << " m^2 needs more than " << options.max_points
          << " points";
  throw std::length_error(message.str());
}

}  // namespace

PointShell sampleSurface(const TriangleMesh& mesh, const ShellOptions& options) {
  validate(mesh);
  validate(options);
  const TriangleMesh surface = welded(mesh);
  if (surface.triangles.empty()) throw std::invalid_argument("no triangle of the mesh has three different corners");
  requireRoom(surfaceArea(surface), options);
  SurfaceFiller filler(surface, options);
  filler.addVertices();
  filler.throwDarts();
  filler.fillGaps();
  PointShell shell = filler.take();
  shell.areas = nearestAreas(surface, shell, options.spacing);
  // The filler has certified the spacing; the measured radius is an upper bound of its own.
  shell.covering_radius = std::min(options.spacing, coveringRadius(surface, shell, options.spacing));
  return shell;
}

}  // namespace sdf_ccd
