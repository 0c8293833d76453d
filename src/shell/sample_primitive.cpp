#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "common/number_text.h"
#include "edge_sampling.h"
#include "sdf_ccd/field.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

/// Lifts a point of the tessellation onto the solid, with the solid's normal there.
void lift(const Sphere& sphere, Vector3d& p, Vector3d& normal) {
  normal = p.normalized();
  p = sphere.radius * normal;
}
void lift(const Box&, Vector3d&, Vector3d&) {}  // the tessellation is the box
void lift(const Cylinder& cylinder, Vector3d& p, Vector3d& normal) {
  const double rho = p.head<2>().norm();
  const bool on_cap = std::abs(p.z()) >= cylinder.halfLength() * (1 - 1e-12);
  const Vector3d axial(0, 0, p.z() < 0 ? -1 : 1);
  if (on_cap) p.z() = axial.z() * cylinder.halfLength();
  if (on_cap && rho < cylinder.radius * (1 - 1e-9)) {
    normal = axial;
    return;
  }
  p.head<2>() *= cylinder.radius / rho;
  normal = Vector3d(p.x(), p.y(), 0) / cylinder.radius;
  if (on_cap) normal = (normal + axial).normalized();
}

/// Upper bound of the tessellation's distance from a curved solid, over the spacing.
constexpr double kDeviation = 0.005;
constexpr double kEdgeDeviation = 0.5;  ///< the same over the edges' flatness

/// Triangles of a sphere's tessellation grow as 1/spacing, its points as 1/spacing²: of those, too, there are too many.
/// @throws std::length_error before a tessellation that would take minutes.
void requireFew(const Sphere& sphere, double deviation, const ShellOptions& options) {
  constexpr double kAlwaysFew = 1e6;
  const double triangles = 4.8 * sphere.radius / deviation;
  if (triangles > std::max(kAlwaysFew, static_cast<double>(options.max_points)))
    throw std::length_error("a point every " + numberText(hasEdges(options) ? options.edge_gap : options.spacing) +
                            " m on a sphere needs more than " + std::to_string(options.max_points) + " points");
}
template <typename Solid>
void requireFew(const Solid&, double, const ShellOptions&) {}

template <typename Solid>
PointShell sampleSolid(const Solid& solid, const ShellOptions& options) {
  constexpr bool curved = !std::is_same_v<Solid, Box>;
  ShellOptions flat = options;
  EdgeSampling edges(options);
  double deviation = 0;
  if (curved) {
    // A surface location is at most a deviation from the tessellation, whose location is at most flat.spacing from a
    // point, and lifting moves the point by at most another deviation.
    deviation = kDeviation * options.spacing;
    if (hasEdges(options)) deviation = std::min(deviation, kEdgeDeviation * edges.flatness);
    edges.radius -= deviation;  // lifting moves the points
    edges.flatness -= deviation;
    edges.covering -= 2 * deviation;
    flat.spacing = options.spacing - 2 * deviation;
    if (hasEdges(options)) flat.edge_gap = options.edge_gap - 2 * deviation;
    // If the tessellation is finer than the shell, its vertices are not features that must be kept.
    flat.vertex_spacing = std::max(options.vertex_spacing, flat.spacing);
    requireFew(solid, deviation, options);
  }
  SampledPoints shell = samplePoints(tessellate(solid, curved ? deviation : options.spacing), flat, edges);
  double area = 0;
  for (const double share : shell.areas) area += share;
  for (std::size_t i = 0; i < shell.size(); ++i) {
    Vector3d normal = shell.normals[i].cast<double>();
    lift(solid, shell.points[i], normal);
    shell.normals[i] = normal.cast<float>();
    shell.areas[i] *= static_cast<float>(surfaceArea(Primitive(solid)) / area);
  }
  shell.covering_radius += 2 * deviation;
  shell.edge_radius += deviation;
  shell.flatness += deviation;
  return toShell(shell);
}

struct Sample {
  const ShellOptions& options;
  template <typename Solid>
  PointShell operator()(const Solid& solid) const {
    return sampleSolid(solid, options);
  }
  PointShell operator()(const HalfSpace&) const {
    throw std::invalid_argument("a half-space has no bounded surface to sample");
  }
};

}  // namespace

PointShell sampleSurface(const Primitive& primitive, const ShellOptions& options) {
  validate(primitive);
  return std::visit(Sample{options}, primitive);
}

}  // namespace sdf_ccd
