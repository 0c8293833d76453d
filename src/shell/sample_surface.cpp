#include "sample_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/infinity.h"
#include "common/number_text.h"
#include "edge_sampling.h"
#include "measure_shell.h"
#include "shell/point_shell.h"
#include "solid/solid_boundary.h"
#include "surface_filler.h"
#include "surface_piece.h"

namespace sdf_ccd {
namespace {

void validate(const ShellOptions& options) {
  const auto refuse = [](const std::string& what, double value) {
    throw std::invalid_argument("a shell's " + what + ", not " + numberText(value) + " m");
  };
  if (!(options.spacing > 0) || !std::isfinite(options.spacing))
    refuse("spacing must be finite and positive", options.spacing);
  if (!(options.vertex_spacing >= 0) || !std::isfinite(options.vertex_spacing))
    refuse("vertex spacing must be finite and not negative", options.vertex_spacing);
  if (!(options.edge_gap >= 0) || !std::isfinite(options.edge_gap))
    refuse("edge gap must be finite and not negative", options.edge_gap);
}

/// Approximate number of points of a sampling without gaps of this spacing, measured on spheres.
double facePoints(double area, double spacing) {
  return 0.7 * area / (spacing * spacing);
}

/// Approximate number of points along edges, measured on robots' links: two radii apart, but closer on short edges, and
/// none where edges meet.
double edgePoints(double length, double radius) {
  return length / (2.0 * radius);
}

constexpr double kEdgesAreMore = 1.3;  ///< factor of edgePoints() on finely curved surfaces

double length(const std::vector<SurfaceEdge>& edges) {
  double sum = 0.0;
  for (const SurfaceEdge& edge : edges) sum += (edge.to - edge.from).norm();
  return sum;
}

/// Number of points that slivers need although they have no area, or of points that take as much time as their slices,
/// whichever is larger; 0 if there are not more slices than points on faces.
/// @param on_faces  number of points on faces.
double sliverPoints(const TriangleMesh& mesh, double spacing, double on_faces) {
  constexpr double kSlicesInTimeOfAPoint = 16.0;
  constexpr double kPointsPerSpacing = 0.62;  // along strips narrower than a spacing; measured on folded sheets, rods
  double slices = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double count = SurfacePiece::of(mesh, static_cast<int>(i)).slices(spacing);
    if (count > 1.0) slices += count;
  }
  if (slices <= on_faces) return 0.0;
  std::vector<SurfaceEdge> edges = edgesOfFlatPieces(mesh, spacing);
  const auto is_short = [&](const SurfaceEdge& edge) { return (edge.to - edge.from).norm() < spacing; };
  edges.erase(std::remove_if(edges.begin(), edges.end(), is_short), edges.end());
  return std::max(kPointsPerSpacing * length(edges) / spacing, slices / kSlicesInTimeOfAPoint);
}

/// Approximate number of points on a whole surface.
double surfacePoints(const TriangleMesh& mesh, double spacing) {
  const double on_faces = facePoints(surfaceArea(mesh), spacing);
  return std::max(on_faces, sliverPoints(mesh, spacing, on_faces));
}

/// @throws std::invalid_argument if the mesh or the options are not valid.
TriangleMesh weldedSurface(const TriangleMesh& mesh, const ShellOptions& options) {
  validate(mesh);
  validate(options);
  TriangleMesh surface = welded(mesh);
  if (surface.triangles.empty()) throw std::invalid_argument("no triangle of the mesh has three different corners");
  return surface;
}

/// The surface and edges to be sampled, for requireRoom().
struct Extent {
  double area = 0.0;            ///< [m²]
  double surface_points = 0.0;  ///< expected number on the surface
  double edges = 0.0;           ///< total length [m]
  double edge_radius = 0.0;     ///< [m]
};

/// Throws std::length_error if more than options.max_points are expected; without this the refusal could come after a
/// minute of sampling.
void requireRoom(const Extent& extent, const ShellOptions& options) {
  const double on_edges = extent.edges > 0.0 ? edgePoints(extent.edges, extent.edge_radius) : 0.0;
  if (extent.surface_points + on_edges <= static_cast<double>(options.max_points)) return;
  std::string message = "a point every " + numberText(options.spacing) + " m on " + numberText(extent.area) + " m^2";
  if (extent.surface_points > facePoints(extent.area, options.spacing)) message += " with many slivers";
  if (on_edges > 0.0) {
    message +=
        " and every " + numberText(2.0 * extent.edge_radius) + " m along " + numberText(extent.edges) + " m of edges";
  }
  throw std::length_error(message + " needs more than " + std::to_string(options.max_points) + " points");
}

}  // namespace

PointShell sampleSurface(const TriangleMesh& mesh, const ShellOptions& options) {
  return sampleSurface(Solid(weldedSurface(mesh, options)), options);
}

PointShell sampleSurface(const Solid& solid, const ShellOptions& options) {
  ShellOptions thinned = options;
  if (solid.seam() > 0.0) {
    // Vertices are dense along seams. A few points suffice there; more would take very long to separate.
    constexpr double kApart = 0.1;
    const double finest = hasEdges(options) ? options.edge_gap : options.spacing;
    thinned.vertex_spacing = std::max(options.vertex_spacing, kApart * finest);
  }
  return toShell(samplePoints(solid.boundary(), thinned, EdgeSampling(options)));
}

SampledPoints samplePoints(const TriangleMesh& mesh, const ShellOptions& requested, const EdgeSampling& sampling) {
  const TriangleMesh surface = weldedSurface(mesh, requested);
  const double area = surfaceArea(surface);
  ShellOptions options = requested;
  std::vector<SurfaceEdge> edges;
  if (hasEdges(requested)) edges = edgesOfFlatPieces(surface, sampling.flatness);
  double edge_length = length(edges);
  if (kEdgesAreMore * edgePoints(edge_length, sampling.radius) > facePoints(area, sampling.covering)) {
    options.spacing = sampling.covering;  // a finely curved surface needs fewer points over all of it than on its edges
    edges.clear();
    edge_length = 0.0;
  }
  requireRoom({area, surfacePoints(surface, options.spacing), edge_length, sampling.radius}, options);
  SurfaceFiller filler(surface, options);
  filler.addVertices();
  filler.fillEdges(edges, sampling.radius);
  filler.throwDarts();
  filler.fillGaps();
  SampledPoints shell = filler.moveOut();
  const ShellMeasures measures = measureShell(surface, shell, options.spacing);
  shell.areas.assign(measures.areas.begin(), measures.areas.end());
  // Both are upper bounds: the filler guarantees the spacing, and the radius is measured.
  shell.covering_radius = std::min(options.spacing, measures.covering_radius);
  if (!edges.empty()) {
    shell.edge_radius = sampling.radius;
    shell.flatness = sampling.flatness;
  }
  return shell;
}

}  // namespace sdf_ccd
