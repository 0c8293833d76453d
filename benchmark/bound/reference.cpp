#include "reference.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace sdf_ccd::benchmark {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Hit = Tree::Intersection_and_primitive_id<Kernel::Segment_3>::Type;

Kernel::Point_3 point(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Distance from the start to the nearer end of the intersection of a segment and a triangle.
double distanceTo(const Kernel::Point_3& start, const Hit& hit) {
  const auto to = [&](const Kernel::Point_3& p) { return std::sqrt(CGAL::squared_distance(start, p)); };
  if (const auto* p = boost::get<Kernel::Point_3>(&hit.first)) return to(*p);
  const auto& shared = boost::get<Kernel::Segment_3>(hit.first);
  return std::min(to(shared.source()), to(shared.target()));
}

}  // namespace

ReferenceDifference compareWithCgal(const precision::ExactSurface& mesh, const std::vector<ExactPoint>& points,
                                    const std::vector<Segment>& segments) {
  Triangles triangles;
  const std::vector<Vector3d>& v = mesh.mesh().vertices;
  for (const Vector3i& t : mesh.mesh().triangles)
    triangles.emplace_back(point(v[t[0]]), point(v[t[1]]), point(v[t[2]]));
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), [](const auto& t) { return t.is_degenerate(); }),
                  triangles.end());
  Tree tree(triangles.begin(), triangles.end());
  ReferenceDifference difference;
  for (const ExactPoint& exact : points) {
    const double distance = std::sqrt(tree.squared_distance(point(exact.p)));
    difference.distance = std::max(difference.distance, std::abs(distance - std::abs(exact.distance)));
  }
  std::vector<Hit> hits;
  for (const Segment& segment : segments) {
    hits.clear();
    tree.all_intersections(Kernel::Segment_3(point(segment.start), point(segment.end)), std::back_inserter(hits));
    std::optional<double> first;
    for (const Hit& hit : hits) {
      const double distance = distanceTo(point(segment.start), hit);
      if (!first || distance < *first) first = distance;
    }
    const std::optional<double> ours = mesh.firstHit(segment);
    difference.lost += first.has_value() != ours.has_value();
    if (!first || !ours) continue;
    difference.hit = std::max(difference.hit, std::abs(*first - *ours * (segment.end - segment.start).norm()));
  }
  return difference;
}

}  // namespace sdf_ccd::benchmark
