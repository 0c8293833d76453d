#include "peers/cgal_triangles.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

#include "oracle/random.h"
#include "oracle/triangle_distance.h"

namespace sdf_ccd::benchmark {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Corners = std::array<Vector3d, 3>;

Kernel::Point_3 toPoint(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Kernel::Segment_3 edge(const Corners& t, int i) {
  return {toPoint(t[i]), toPoint(t[(i + 1) % 3])};
}

/// Whether an edge of the first triangle intersects the second. False for a second triangle of no area: the distances
/// between its edges and those of the first cover that case.
bool cuts(const Corners& edges, const Corners& t) {
  const Kernel::Triangle_3 triangle(toPoint(t[0]), toPoint(t[1]), toPoint(t[2]));
  if (triangle.is_degenerate()) return false;
  for (int i = 0; i < 3; ++i) {
    if (!edge(edges, i).is_degenerate() && CGAL::do_intersect(edge(edges, i), triangle)) return true;
  }
  return false;
}

/// Distance of two triangles. If they do not intersect, it is that of two edges, or of a vertex and a triangle.
double distance(const Corners& a, const Corners& b) {
  if (cuts(a, b) || cuts(b, a)) return 0.0;
  Number best = CGAL::squared_distance(toPoint(a[0]), toPoint(b[0]));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) best = std::min(best, Number(CGAL::squared_distance(edge(a, i), edge(b, k))));
  for (const auto& [t, u] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    const Kernel::Triangle_3 triangle(toPoint((*t)[0]), toPoint((*t)[1]), toPoint((*t)[2]));
    if (triangle.is_degenerate()) continue;
    for (int i = 0; i < 3; ++i) best = std::min(best, Number(CGAL::squared_distance(toPoint((*u)[i]), triangle)));
  }
  return std::sqrt(CGAL::to_double(best));
}

Corners draw(test::Random& random, bool is_whole) {
  Corners t;
  for (Vector3d& p : t) {
    for (int k = 0; k < 3; ++k) p[k] = is_whole ? double(random() % 3) : test::uniform(random, -1.0, 1.0);
  }
  return t;
}

}  // namespace

OracleError compareWithCgal(std::uint64_t seed, long pairs) {
  constexpr double kRounding = 1e-15;
  test::Random random(seed);
  OracleError error;
  for (; error.pairs < pairs; ++error.pairs) {
    const bool is_whole = error.pairs % 2 == 0;
    const Corners a = draw(random, is_whole), b = draw(random, is_whole);
    test::Triangle3r c, d;
    for (int k = 0; k < 3; ++k) {
      c[k] = a[k].cast<test::Real>();
      d[k] = b[k].cast<test::Real>();
    }
    const double truth = distance(a, b), ours = double(test::triangleDistance(c, d));
    error.touching += truth == 0.0;
    error.wrong_touch += (truth == 0.0) != (ours == 0.0) && std::max(truth, ours) > kRounding;
    error.largest = std::max(error.largest, std::abs(truth - ours));
  }
  return error;
}

}  // namespace sdf_ccd::benchmark
