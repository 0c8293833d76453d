#include "measured_patch.h"

#include <algorithm>
#include <cmath>

#include "common/parallel_for.h"
#include "mesh/corners.h"

namespace sdf_ccd {
MeasuredPatch measurePatch(const TriangleMesh& mesh, const Patch& patch) {
  MeasuredPatch result;
  const TriangleMesh part = extract(mesh, patch);
  result.box = boundingBox(part);
  if (!patch.closed) return result;
  const double volume = signedVolume(part), size = result.box.sizes().maxCoeff();
  result.inward = volume < 0.0;
  if (!(size > 1e-9 && std::abs(volume) > 1e-7 * size * surfaceArea(part))) return result;
  result.tree = std::make_unique<TriangleTree>(part);

  const std::size_t count = part.triangles.size();
  std::vector<Vector3d> behind(count);
  std::vector<double> numbers(count, 0.0);
  std::vector<char> known(count, 0);
  parallelFor(std::size_t{0}, count, [&](std::size_t i) {
    const Corners c = cornersOf(part, static_cast<int>(i));
    const Vector3d area_normal = areaNormal(part, static_cast<int>(i));
    const double longest = longestEdge(c);
    if (!(area_normal.norm() > 1e-6 * longest * longest)) return;
    behind[i] = centroid(c) - 1e-6 * area_normal / longest;
    numbers[i] = result.tree->windingNumber(behind[i]);
    known[i] = 1;
  });

  int facing_out = 0, facing_in = 0;
  double area_out = 0.0, area_in = 0.0, farthest = -kInfinity;
  for (std::size_t i = 0; i < count; ++i) {
    if (!known[i]) continue;
    ++(numbers[i] > 0.5 ? facing_out : facing_in);
    // Visible from where the number is zero: the front of a triangle with 1 behind it, the back of one with 0 behind
    // it.
    const long number = std::lround(numbers[i]);
    const double area = areaNormal(part, static_cast<int>(i)).norm();
    if (number == 1) area_out += area;
    if (number == 0) area_in += area;
    if (behind[i].x() > farthest) {
      farthest = behind[i].x();
      result.witness = centroid(cornersOf(part, static_cast<int>(i)));
      result.behind = behind[i];
    }
  }
  // If both areas are similar, the sign of the volume decides.
  if (area_in > 2.0 * area_out) result.inward = true;
  if (area_out > 2.0 * area_in) result.inward = false;
  result.negative_triangles = result.inward ? facing_out : facing_in;
  return result;
}

}  // namespace sdf_ccd
