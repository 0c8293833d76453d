#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A unit vector in four bytes: its projection onto the octahedron |x| + |y| + |z| = 1, unfolded to a square, with 16
/// bits per coordinate.
///
/// Source: Cigolle et al. 2014, A survey of efficient representations for independent unit vectors (oct32).
/// Guarantee: vector() deviates from the vector that was packed by at most kMaxError; the axes' directions are exact.
struct PackedNormal {
  /// The angle [rad]. Rounding displaces a point of the octahedron by at most (δ, δ, 2δ), δ = 1/65534. All of it is
  /// outside the ball of radius 1/√3 about the origin, and projecting onto a ball increases no distance: the unit
  /// vectors differ by at most √3 · √6 δ.
  static constexpr double kMaxError = 6.5e-5;

  std::int16_t u = 0, v = 0;  ///< of the square, ±32767 at its sides; +z is its center

  PackedNormal() = default;
  /// @param n  of any length; one that is zero or not finite gives +z.
  explicit PackedNormal(const Vector3d& n);

  /// The unit vector.
  Vector3d vector() const {
    constexpr double kUnit = 1.0 / 32767.0;
    const double x = kUnit * u, y = kUnit * v, z = 1.0 - std::abs(x) - std::abs(y);
    const double folded = z < 0.0 ? -z : 0.0;  // the lower half's corners, which are outside |x| + |y| = 1
    return Vector3d(x - std::copysign(folded, x), y - std::copysign(folded, y), z).normalized();
  }
};

/// Points on a body's surface, in its frame P, in 20 bytes each.
///
/// A point is exactly where point() says: spheres, radii, contacts and depths refer to it. It may be displaced from the
/// surface, or from where it was added, by up to position_error.
struct PointShell {
  Vector3d origin = Vector3d::Zero();  ///< that positions are relative to [m]; errors are least in the points' middle
  std::vector<Vector3f> offsets;       ///< of the points from the origin [m]
  std::vector<PackedNormal> normals;   ///< pointing out
  std::vector<float> areas;            ///< surface area that each point represents [m²]
  double covering_radius = 0.0;        ///< upper bound of the distance from the surface's locations to the points [m]

  /// The same for the edges of its flat pieces, which deviate from planes by `flatness` [m]; see contact_gap.h.
  /// Infinite if edges have not been sampled separately.
  double edge_radius = std::numeric_limits<double>::infinity();
  double flatness = 0.0;

  /// Upper bound of the displacement of points by rounding [m]; each rounding adds up to 6e-8 of the largest distance
  /// of a point from the origin.
  double position_error = 0.0;

  /// Memory of a point [B].
  static constexpr std::size_t kBytesPerPoint = sizeof(Vector3f) + sizeof(PackedNormal) + sizeof(float);

  /// Number of points.
  std::size_t size() const { return offsets.size(); }

  /// Position of a point [m].
  Vector3d point(std::size_t i) const { return origin + offsets[i].cast<double>(); }

  /// Outward unit normal of a point, within PackedNormal::kMaxError of the one that was added.
  Vector3d normal(std::size_t i) const { return normals[i].vector(); }

  /// Positions of all points, copied [m].
  std::vector<Vector3d> points() const;

  /// Adds a point, and increases position_error if its position is rounded by more.
  /// @param area  [m²].
  void add(const Vector3d& p, const Vector3d& normal, float area);
};

/// Bounding spheres over the points of a shell (paper §3.3), nested: each node's sphere holds all points below it.
struct SphereTree {
  /// A sphere around consecutive points, in single precision.
  struct Node {
    Vector3f center;     ///< [m], frame P
    float radius;        ///< about the rounded center, rounded up [m]
    std::int32_t begin;  ///< points [begin, end) of the shell lie below this node
    std::int32_t end;
    std::int32_t first_child;  ///< of two consecutive ones; -1 for a leaf

    /// Whether it has points, but no nodes, below it.
    bool isLeaf() const { return first_child < 0; }

    /// The sphere in double precision.
    BoundingBall ball() const { return {center.cast<double>(), double(radius)}; }
  };
  /// Root first, level by level: children of neighbours are neighbours too. Empty for an empty shell.
  std::vector<Node> nodes;
};

/// Builds the tree; the shell's points (and normals and areas) are reordered so that every node's are consecutive.
SphereTree buildSphereTree(PointShell& shell);

/// Writes a point shell, as saveField() does a field.
/// @throws std::runtime_error naming the path and the reason, also if loadShell() would refuse the shell.
void saveShell(const PointShell& shell, const std::string& path, const std::string& key = {});

/// Reads a shell file, as loadField().
/// @throws std::runtime_error naming the path and what is wrong with the file.
PointShell loadShell(const std::string& path, const std::string& key = {});

}  // namespace sdf_ccd
