#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "oracle/random.h"
#include "oracle/shapes.h"

/// Boxes in one mesh, and facts about their union that do not depend on the triangles.
namespace sdf_ccd::test {

struct OrientedBox {
  Isometry3d X_WB = Isometry3d::Identity();
  Vector3d half_size;
  bool inside_out = false;

  /// The largest distance of a point beyond one of the face planes; negative inside. A lower bound of the distance.
  double outside(const Vector3d& p) const { return ((X_WB.inverse() * p).cwiseAbs() - half_size).maxCoeff(); }
};

inline OrientedBox boxAt(const Vector3d& center, const Vector3d& half_size) {
  OrientedBox box;
  box.X_WB.translation() = center;
  box.half_size = half_size;
  return box;
}

inline TriangleMesh meshOf(const std::vector<OrientedBox>& boxes) {
  TriangleMesh mesh;
  for (const OrientedBox& box : boxes) {
    TriangleMesh one = transformed(boxMesh(box.half_size), box.X_WB);
    mesh = merged(std::move(mesh), box.inside_out ? flipped(std::move(one)) : one);
  }
  return mesh;
}

/// Signed distance to the union of axis-aligned boxes, none of them inside out. The planes of all faces form
/// rectangles; those with a box on one side only are the union's boundary.
inline double distanceToUnion(const std::vector<OrientedBox>& boxes, const Vector3d& p) {
  std::array<std::vector<double>, 3> planes;
  for (const OrientedBox& box : boxes) {
    for (int k = 0; k < 3; ++k) {
      const double middle = box.X_WB.translation()[k];
      planes[k].insert(planes[k].end(), {middle - box.half_size[k], middle + box.half_size[k]});
    }
  }
  for (std::vector<double>& along : planes) {
    std::sort(along.begin(), along.end());
    const auto same = [](double a, double b) { return b - a < 1e-9; };
    along.erase(std::unique(along.begin(), along.end(), same), along.end());
  }
  const auto isInside = [&](const Vector3d& q) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const OrientedBox& box) { return box.outside(q) < 0; });
  };
  constexpr double kBeside = 1e-6;  // distance from a plane; all other planes are farther from it
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const std::vector<double>&across = planes[(k + 1) % 3], &up = planes[(k + 2) % 3];
    for (const double plane : planes[k])
      for (std::size_t i = 0; i + 1 < across.size(); ++i)
        for (std::size_t j = 0; j + 1 < up.size(); ++j) {
          Vector3d q;
          q[(k + 1) % 3] = 0.5 * (across[i] + across[i + 1]);
          q[(k + 2) % 3] = 0.5 * (up[j] + up[j + 1]);
          const auto beside = [&](double shift) {
            q[k] = plane + shift;
            return isInside(q);
          };
          if (beside(kBeside) == beside(-kBeside)) continue;
          q[k] = plane;
          q[(k + 1) % 3] = std::clamp(p[(k + 1) % 3], across[i], across[i + 1]);
          q[(k + 2) % 3] = std::clamp(p[(k + 2) % 3], up[j], up[j + 1]);
          nearest = std::min(nearest, (p - q).norm());
        }
  }
  return isInside(p) ? -nearest : nearest;
}

/// A point on a face of one box, and the winding numbers one step in front of and behind it.
struct FacePlace {
  Vector3d point;
  bool certain;  ///< other faces contain the point or are 2 steps away, and half a step from the points beside it
  int before, behind;
};

inline FacePlace randomFacePlace(const std::vector<OrientedBox>& boxes, double step, Random& random) {
  const OrientedBox& own = boxes[random() % boxes.size()];
  const int axis = static_cast<int>(random() % 3);
  Vector3d p = uniformIn(random, {-own.half_size, own.half_size}), normal = Vector3d::Zero();
  normal[axis] = random() % 2 == 0 ? 1.0 : -1.0;
  p[axis] = normal[axis] * own.half_size[axis];
  FacePlace place{own.X_WB * p, true, 0, 0};
  normal = own.X_WB.linear() * normal;
  for (const OrientedBox& box : boxes) {
    const double away = std::abs(box.outside(place.point));
    place.certain = place.certain && (away < 1e-5 * step || away > 2.0 * step);
  }
  const auto winding = [&](const Vector3d& q) {
    int sum = 0;
    for (const OrientedBox& box : boxes) {
      const double outside = box.outside(q);
      place.certain = place.certain && std::abs(outside) > 0.5 * step;
      if (outside < 0.0) sum += box.inside_out ? -1 : 1;
    }
    return sum;
  };
  place.before = winding(place.point + step * normal);
  place.behind = winding(place.point - step * normal);
  return place;
}

}  // namespace sdf_ccd::test
