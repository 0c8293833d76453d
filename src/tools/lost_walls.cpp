#include "lost_walls.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "common/number_text.h"
#include "common/parallel_for.h"
#include "mesh/corners.h"

namespace sdf_ccd::tools {
namespace {

constexpr double kSpread = 20000.0;   // points over the whole surface
constexpr double kNoticeable = 1e-3;  // of the area

/// Tests single points of the surface.
class WallTest {
 public:
  WallTest(const DistanceField& field, const Solid& solid)
      : field_(field), tree_(solid.tree()), error_(field.errorBound()) {}

  /// The thickness of the wall at a point, if the field does not show it [m].
  /// @param normal  outward, unit.
  std::optional<double> lostAt(const Vector3d& p, const Vector3d& normal) const {
    // A field is negative where the solid is deeper than its error. That proves most points.
    for (const double depth : {error_, 0.5 * error_, 0.25 * error_})
      if (isInside(p - depth * normal)) return std::nullopt;
    const std::optional<double> thickness = thicknessAt(p, normal);
    if (!thickness) return 0.0;
    // Of thicker walls only edges are rounded off.
    if (*thickness >= 2.0 * error_) return std::nullopt;
    constexpr int kSteps = 16;
    for (int i = 0; i <= kSteps; ++i)
      if (isInside(p - *thickness * i / kSteps * normal)) return std::nullopt;
    return thickness;
  }

 private:
  bool isInside(const Vector3d& p) const { return field_.interpolate(p).value <= 0.0; }

  /// The way through the solid to where it ends; none if there is nothing behind the point.
  std::optional<double> thicknessAt(const Vector3d& p, const Vector3d& normal) const {
    constexpr double kBeside = 1e-6;  // of the error: the point's own triangle is not met
    const int met = tree_.firstHit(p, -normal, kBeside * error_);
    if (met < 0) return std::nullopt;
    const Corners& corners = tree_.triangle(met).corners();
    const Vector3d other = areaNormal(corners);
    const double across = -other.dot(normal);
    if (!(across > 0.0)) return std::nullopt;
    return std::max(0.0, other.dot(corners[0] - p) / across);
  }

  const DistanceField& field_;
  const TriangleTree& tree_;
  double error_;
};

}  // namespace

LostSurface findLostSurface(const DistanceField& field, const Solid& solid) {
  const TriangleMesh& mesh = solid.boundary();
  const double area = surfaceArea(mesh);
  const WallTest test(field, solid);
  std::vector<LostSurface> lost(mesh.triangles.size());  // of each triangle, the share of its own area
  parallelFor(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const Corners t = cornersOf(mesh, static_cast<int>(i));
    const Vector3d area_normal = areaNormal(t);
    if (!(area_normal.norm() > 0.0)) return;
    const Vector3d normal = area_normal.normalized();
    const int points = 1 + static_cast<int>(kSpread * 0.5 * area_normal.norm() / area);
    for (int k = 0; k < points; ++k) {
      // The R2 sequence (Roberts 2018), folded into the triangle; its first point is the centroid.
      double u = std::fmod(1.0 / 3.0 + 0.7548776662466927 * k, 1.0);
      double v = std::fmod(1.0 / 3.0 + 0.5698402909980532 * k, 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vector3d p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      const std::optional<double> thickness = test.lostAt(p, normal);
      if (!thickness) continue;
      lost[i].share += 1.0 / points;
      lost[i].thickest = std::max(lost[i].thickest, *thickness);
    }
  });
  LostSurface all;
  for (std::size_t i = 0; i < lost.size(); ++i) {
    all.share += lost[i].share * 0.5 * areaNormal(mesh, static_cast<int>(i)).norm() / area;
    all.thickest = std::max(all.thickest, lost[i].thickest);
  }
  all.share = std::min(all.share, 1.0);
  return all;
}

bool isNoticed(const LostSurface& lost) {
  return lost.share > kNoticeable;
}

std::string describeLost(const LostSurface& lost, const DistanceField& field) {
  if (!isNoticed(lost)) return {};
  return fmt::format(
      "{:.3g} % of the surface are walls of up to {} m that are too thin for this field: what passes through them is "
      "not seen; walls of {} m or more are kept",
      100.0 * lost.share, shortText(lost.thickest), shortText(2.0 * field.errorBound()));
}

}  // namespace sdf_ccd::tools
