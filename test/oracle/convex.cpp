#include "oracle/convex.h"

#include <algorithm>
#include <array>
#include <limits>

namespace sdf_ccd::test {
namespace {

/// Edges within this angle are parallel: their cross product is no additional axis [rad].
constexpr Real kParallel = 1e-12L;

void addDirection(const Vector3l& v, std::vector<Vector3l>& directions) {
  const Real length = v.norm();
  if (length == 0) return;
  const Vector3l unit = v / length;
  for (const Vector3l& d : directions)
    if (d.cross(unit).norm() < kParallel) return;
  directions.push_back(unit);
}

void finish(Convex& convex) {
  for (const Vector3l& p : convex.corners) convex.center += p / Real(convex.corners.size());
  for (const Vector3l& p : convex.corners) convex.radius = std::max(convex.radius, (p - convex.center).norm());
}

struct Range {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
};

Range along(const std::vector<Vector3l>& points, const Vector3l& axis) {
  Range range;
  for (const Vector3l& p : points) {
    const Real x = axis.x() * p.x() + axis.y() * p.y() + axis.z() * p.z();
    if (x < range.low) range.low = x;
    if (x > range.high) range.high = x;
  }
  return range;
}

/// Finds the axis with the largest gap, in A's frame.
class AxisSearch {
 public:
  AxisSearch(const Convex& a, const std::vector<Vector3l>& corners_b) : a_(a), b_(corners_b) {}

  void add(const Vector3l& axis) {
    const Range a = along(a_.corners, axis), b = along(b_, axis);
    take(b.low - a.high, axis);
    take(a.low - b.high, -axis);
  }

  const Separation& best() const { return best_; }

 private:
  void take(Real gap, const Vector3l& axis) {
    if (gap <= best_.value) return;
    best_.value = gap;
    best_.axis_W = axis;
  }

  const Convex& a_;
  const std::vector<Vector3l>& b_;
  Separation best_{-std::numeric_limits<Real>::infinity(), Vector3l::UnitX()};
};

Real clamped(Real x) {
  return std::min(std::max(x, Real(0)), Real(1));
}

/// Ericson 2005, §5.1.9.
Real segmentDistance(const Vector3l& p, const Vector3l& d, const Vector3l& q, const Vector3l& e) {
  const Vector3l r = p - q;
  const Real dd = d.dot(d), ee = e.dot(e), f = e.dot(r), c = d.dot(r), b = d.dot(e), denominator = dd * ee - b * b;
  Real s = denominator > 0 ? clamped((b * f - c * ee) / denominator) : 0;
  Real t = (b * s + f) / ee;
  if (t < 0 || t > 1) {
    t = clamped(t);
    s = clamped((b * t - c) / dd);
  }
  return (r + s * d - t * e).norm();
}

using Triangle3l = std::array<Vector3l, 3>;

Real cornerDistance(const Vector3l& p, const Triangle3l& t) {
  const Vector3l n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool within = true;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector3l edge = t[(k + 1) % 3] - t[k];
    within &= n.cross(edge).dot(p - t[k]) >= 0;
    nearest = std::min(nearest, (p - t[k] - clamped(edge.dot(p - t[k]) / edge.dot(edge)) * edge).norm());
  }
  return within && n.norm() > 0 ? std::min(nearest, std::abs(n.normalized().dot(p - t[0]))) : nearest;
}

Real triangleDistance(const Triangle3l& a, const Triangle3l& b) {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      nearest = std::min(nearest, segmentDistance(a[i], a[(i + 1) % 3] - a[i], b[k], b[(k + 1) % 3] - b[k]));
    nearest = std::min({nearest, cornerDistance(a[i], b), cornerDistance(b[i], a)});
  }
  return nearest;
}

LongPose relative(const LongPose& X_WA, const LongPose& X_WB) {
  return {X_WA.R.transpose() * X_WB.R, X_WA.R.transpose() * (X_WB.p - X_WA.p)};
}

Separation ballSeparation(const Convex& a, const LongPose& X_WA, const Convex& b, const LongPose& X_WB) {
  const Vector3l apart = X_WB * b.center - X_WA * a.center;
  const Vector3l axis = apart.norm() > 0 ? Vector3l(apart.normalized()) : Vector3l(Vector3l::UnitX());
  if (a.is_ball && b.is_ball) return {apart.norm() - a.radius - b.radius, axis};
  const Convex &round = a.is_ball ? a : b, &flat = a.is_ball ? b : a;
  const LongPose &X_round = a.is_ball ? X_WA : X_WB, &X_flat = a.is_ball ? X_WB : X_WA;
  const Vector3l center = X_flat.R.transpose() * (X_round * round.center - X_flat.p);
  return {signedDistance(flat, center) - round.radius, axis};
}

}  // namespace

Convex convexOf(const TriangleMesh& mesh) {
  Convex convex;
  for (const Vector3d& v : mesh.vertices) convex.corners.push_back(v.cast<Real>());
  for (const Vector3i& t : mesh.triangles) {
    const std::vector<Vector3l>& v = convex.corners;
    convex.triangles.push_back({v[t[0]], v[t[1]], v[t[2]]});
    addDirection((v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]), convex.normals);
    for (int k = 0; k < 3; ++k) addDirection(v[t[(k + 1) % 3]] - v[t[k]], convex.edges);
  }
  finish(convex);
  return convex;
}

Convex polygon(const std::vector<Vector3d>& corners) {
  Convex convex;
  for (const Vector3d& p : corners) convex.corners.push_back(p.cast<Real>());
  const std::vector<Vector3l>& v = convex.corners;
  for (std::size_t k = 1; k + 1 < v.size(); ++k) convex.triangles.push_back({v[0], v[k], v[k + 1]});
  const Vector3l normal = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
  addDirection(normal, convex.normals);
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Vector3l edge = v[(k + 1) % v.size()] - v[k];
    addDirection(edge, convex.edges);
    addDirection(normal.cross(edge), convex.normals);
  }
  finish(convex);
  return convex;
}

Convex ball(double radius) {
  Convex convex;
  for (int k = 0; k < 8; ++k)
    convex.corners.push_back(Real(radius) * Vector3l(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  convex.is_ball = true;
  convex.radius = Real(radius);
  return convex;
}

Separation separation(const Convex& a, const LongPose& X_WA, const Convex& b, const LongPose& X_WB) {
  if (a.is_ball || b.is_ball) return ballSeparation(a, X_WA, b, X_WB);
  const LongPose X_AB = relative(X_WA, X_WB);
  thread_local std::vector<Vector3l> corners, edges;
  corners.clear();
  edges.clear();
  for (const Vector3l& p : b.corners) corners.push_back(X_AB * p);
  AxisSearch search(a, corners);
  for (const Vector3l& n : a.normals) search.add(n);
  for (const Vector3l& n : b.normals) search.add(X_AB.R * n);
  for (const Vector3l& e : b.edges) edges.push_back(X_AB.R * e);
  for (const Vector3l& d : a.edges) {
    for (const Vector3l& e : edges) {
      const Vector3l axis = d.cross(e);
      const Real length = axis.norm();
      if (length > kParallel) search.add(axis / length);
    }
  }
  Separation best = search.best();
  best.axis_W = X_WA.R * best.axis_W;
  return best;
}

Separation separation(const Pieces& a, const LongPose& X_WA, const Pieces& b, const LongPose& X_WB,
                      const VisitPair& visit) {
  Separation least{std::numeric_limits<Real>::infinity(), Vector3l::UnitX()};
  for (const Convex& piece_a : a) {
    const Vector3l center = X_WA * piece_a.center;
    for (const Convex& piece_b : b) {
      const Vector3l apart = X_WB * piece_b.center - center;
      const Real length = apart.norm(), balls = length - piece_a.radius - piece_b.radius;
      if (balls >= least.value) {
        if (visit) visit(piece_a, piece_b, {balls, length > 0 ? Vector3l(apart / length) : Vector3l::UnitX()});
        continue;
      }
      const Separation found = separation(piece_a, X_WA, piece_b, X_WB);
      if (visit) visit(piece_a, piece_b, found);
      if (found.value < least.value) least = found;
    }
  }
  return least;
}

Real surfaceDistance(const Pieces& a, const LongPose& X_WA, const Pieces& b, const LongPose& X_WB) {
  const LongPose X_AB = relative(X_WA, X_WB);
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Convex& piece_b : b) {
    const Vector3l center = X_AB * piece_b.center;
    for (const Convex& piece_a : a) {
      if ((center - piece_a.center).norm() - piece_a.radius - piece_b.radius >= nearest) continue;
      if (piece_a.is_ball || piece_b.is_ball) {
        nearest = std::min(nearest, std::abs(separation(piece_a, X_WA, piece_b, X_WB).value));
        continue;
      }
      for (const Triangle3l& t : piece_b.triangles) {
        const Triangle3l moved{X_AB * t[0], X_AB * t[1], X_AB * t[2]};
        for (const Triangle3l& u : piece_a.triangles) nearest = std::min(nearest, triangleDistance(u, moved));
      }
    }
  }
  return nearest;
}

Real signedDistance(const Convex& solid, const Vector3l& p) {
  if (solid.is_ball) return (p - solid.center).norm() - solid.radius;
  Real outside = -std::numeric_limits<Real>::infinity(), nearest = -outside;
  for (const Vector3l& n : solid.normals) {
    const Range range = along(solid.corners, n);
    outside = std::max({outside, n.dot(p) - range.high, range.low - n.dot(p)});
  }
  if (outside <= 0) return outside;
  for (const Triangle3l& t : solid.triangles) nearest = std::min(nearest, cornerDistance(p, t));
  return nearest;
}

}  // namespace sdf_ccd::test
