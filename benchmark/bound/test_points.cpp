#include "test_points.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/uniform/sparse_grid.h"

#include <cmath>

namespace sdf_ccd::benchmark {
namespace {

using namespace precision;

double sideOf(const ExactSurface& mesh) {
  return boundingBox(mesh.mesh()).sizes().maxCoeff();
}

/// A random point on a triangle's edge; in one of four cases a vertex.
Vector3d onEdge(const TriangleMesh& mesh, Random& random) {
  const Vector3i& t = mesh.triangles[random() % mesh.triangles.size()];
  const int k = int(random() % 3);
  const Vector3d &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]];
  return random() % 4 == 0 ? a : Vector3d(a + uniform(random, 0.0, 1.0) * (b - a));
}

/// A length from 1e-9 to 0.1 of the side, log-uniform.
double anyLength(double side, Random& random) {
  return side * std::pow(10.0, uniform(random, -9.0, -1.0));
}

/// The point farthest inwards along the normal from which `on_surface` is still the nearest point of the surface.
Vector3d medialPoint(const ExactSurface& mesh, int triangle, const Vector3d& on_surface) {
  const Vector3d inward = -areaNormal(mesh.mesh(), triangle).normalized();
  double near = 0.0, far = sideOf(mesh);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (near + far);
    const bool nearest = mesh.unsignedDistance(on_surface + middle * inward) > middle * (1.0 - 1e-9);
    (nearest ? near : far) = middle;
  }
  return on_surface + near * inward;
}

/// Faces between cells lie at multiples of this from the grid's origin [m].
double cellOf(const DistanceField& field) {
  return FieldAccess::adaptive(field) ? FieldAccess::adaptive(field)->shape().unit()
                                      : FieldAccess::grid(field)->shape().cell;
}

Vector3d originOf(const DistanceField& field) {
  return FieldAccess::adaptive(field) ? FieldAccess::adaptive(field)->shape().origin
                                      : FieldAccess::grid(field)->shape().origin;
}

/// p with one coordinate moved to the nearest face between cells; in an adaptive field, to the lower face of its leaf.
Vector3d onFace(const DistanceField& field, const Vector3d& p, int axis) {
  const double cell = cellOf(field);
  const Vector3d origin = originOf(field);
  Vector3d on = p;
  double line = std::round((p[axis] - origin[axis]) / cell);
  if (const AdaptiveGrid* grid = FieldAccess::adaptive(field); grid && field.box().contains(p)) {
    const Vector3i last = grid->shape().units().array() - 1;
    const Vector3i unit = ((p - origin) / cell).array().floor().max(0.0).matrix().cast<int>().cwiseMin(last);
    line = grid->block(unit).low[axis];
  }
  on[axis] = origin[axis] + line * cell;
  return on;
}

}  // namespace

std::vector<ExactPoint> pointsOfMesh(const ExactSurface& mesh, std::size_t count, Random& random) {
  const double side = sideOf(mesh);
  AlignedBox3d box = boundingBox(mesh.mesh());
  box = {box.min() - 0.5 * box.sizes(), box.max() + 0.5 * box.sizes()};
  std::vector<ExactPoint> points;
  const auto add = [&](const Vector3d& p) { points.push_back({p, mesh.distance(p)}); };
  for (std::size_t i = 0; i < count; ++i) add(uniformIn(random, box));
  const SurfaceSampler surface(mesh.mesh());
  for (std::size_t i = 0; i < count; ++i) {
    add(surface(random) + uniform(random, 0.0, 0.02 * side) * direction(random));
  }
  for (std::size_t i = 0; i < count; ++i) {
    add(onEdge(mesh.mesh(), random) + anyLength(side, random) * direction(random));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const int triangle = surface.triangle(random);
    add(medialPoint(mesh, triangle, surface.pointOn(random, triangle)));
  }
  return points;
}

std::vector<ExactPoint> pointsOfField(const DistanceField& field, const ExactSurface& mesh, std::size_t count,
                                      Random& random) {
  const double side = sideOf(mesh), band = field.band();
  std::vector<ExactPoint> points;
  const auto add = [&](const Vector3d& p) { points.push_back({p, mesh.distance(p)}); };
  const SurfaceSampler surface(mesh.mesh());
  for (std::size_t i = 0; i < count; ++i) {
    const int axis = int(random() % 3);
    Vector3d on = onFace(field, surface(random) + uniform(random, 0.0, band) * direction(random), axis);
    const int beside = int(random() % 3) - 1;
    on[axis] += beside * 1e-12 * side;
    add(on);
  }
  for (std::size_t i = 0; i < count; ++i) {
    add(surface(random) + uniform(random, 0.95, 1.05) * band * direction(random));
  }
  return points;
}

std::vector<Segment> segmentsOfMesh(const ExactSurface& mesh, std::size_t count, Random& random) {
  const double side = sideOf(mesh);
  AlignedBox3d box = boundingBox(mesh.mesh());
  box = {box.min().array() - 0.2 * side, box.max().array() + 0.2 * side};
  std::vector<Segment> segments;
  const auto add = [&](const Vector3d& start, const Vector3d& end) {
    const bool starts_outside = !mesh.surface().inside(start);
    if (starts_outside) segments.push_back({start, end});
    return starts_outside;
  };
  for (std::size_t i = 0; i < count;) i += add(uniformIn(random, box), uniformIn(random, box));
  const SurfaceSampler surface(mesh.mesh());
  for (std::size_t i = 0; i < count;) {
    const Vector3d start = surface(random) + uniform(random, 0.0, 0.03 * side) * direction(random);
    i += add(start, start + 0.02 * side * direction(random));
  }
  for (std::size_t i = 0; i < count;) {
    const int triangle = surface.triangle(random);
    const Vector3d p = surface.pointOn(random, triangle), normal = areaNormal(mesh.mesh(), triangle).normalized();
    const Vector3d along = normal.cross(direction(random)).normalized();
    const Vector3d middle = p + uniform(random, -1e-3, 1e-3) * side * normal;
    i += add(middle - 0.5 * side * along, middle + 0.5 * side * along);
  }
  for (std::size_t i = 0; i < count;) {
    const Vector3d p = onEdge(mesh.mesh(), random);
    const Vector3d start = p + uniform(random, 0.05, 0.5) * side * direction(random);
    i += add(start, p + uniform(random, 0.0, 0.5) * (p - start));
  }
  return segments;
}

std::vector<Segment> segmentsOfField(const DistanceField& field, const ExactSurface& mesh, std::size_t count,
                                     Random& random) {
  const double side = sideOf(mesh);
  const SurfaceSampler surface(mesh.mesh());
  std::vector<Segment> segments;
  while (segments.size() < count) {
    const int axis = int(random() % 3);
    const Vector3d p = onFace(field, surface(random), axis);
    Vector3d along = direction(random);
    along[axis] = 0.0;
    const Segment segment{p - 0.3 * side * along, p + 0.3 * side * along};
    if (!mesh.surface().inside(segment.start)) segments.push_back(segment);
  }
  return segments;
}

}  // namespace sdf_ccd::benchmark
