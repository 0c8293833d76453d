// Vector code that is compiled once for each kind of processor; see segment_lanes.cpp.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "surface/triangle_pairs.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "triangle_pairs.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, TrianglePairs::kSize>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr D d;

HWY_INLINE V real(double x) {
  return hn::Set(d, x);
}

struct Point {
  HWY_INLINE Point() {}  // the implicit constructor is not compiled for this target
  HWY_INLINE Point(V x0, V y0, V z0) : x(x0), y(y0), z(z0) {}
  HWY_INLINE explicit Point(const Vector3d& p) : x(real(p.x())), y(real(p.y())), z(real(p.z())) {}

  V x, y, z;
};

HWY_INLINE Point operator-(const Point& p, const Point& q) {
  return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
HWY_INLINE V dot(const Point& p, const Point& q) {
  return hn::MulAdd(p.x, q.x, hn::MulAdd(p.y, q.y, hn::Mul(p.z, q.z)));
}
HWY_INLINE Point cross(const Point& p, const Point& q) {
  return {hn::MulSub(p.y, q.z, hn::Mul(p.z, q.y)), hn::MulSub(p.z, q.x, hn::Mul(p.x, q.z)),
          hn::MulSub(p.x, q.y, hn::Mul(p.y, q.x))};
}
/// p + s q
HWY_INLINE Point along(const Point& p, V s, const Point& q) {
  return {hn::MulAdd(s, q.x, p.x), hn::MulAdd(s, q.y, p.y), hn::MulAdd(s, q.z, p.z)};
}
HWY_INLINE Point scaled(const Point& p, V s) {
  return {hn::Mul(p.x, s), hn::Mul(p.y, s), hn::Mul(p.z, s)};
}
HWY_INLINE Point halfway(const Point& p, const Point& q) {
  const V half = real(0.5);
  return {hn::Mul(half, hn::Add(p.x, q.x)), hn::Mul(half, hn::Add(p.y, q.y)), hn::Mul(half, hn::Add(p.z, q.z))};
}
HWY_INLINE Point selected(M which, const Point& yes, const Point& no) {
  return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y), hn::IfThenElse(which, yes.z, no.z)};
}
HWY_INLINE V least(V a, V b, V c) {
  return hn::Min(a, hn::Min(b, c));
}
HWY_INLINE V most(V a, V b, V c) {
  return hn::Max(a, hn::Max(b, c));
}

struct Triangle {
  HWY_INLINE Triangle() {}  // as Point()
  HWY_INLINE Triangle(const std::array<TrianglePairs::Vectors, 3>& corners, int first) {
    for (int i = 0; i < 3; ++i)
      p[i] = Point(hn::Load(d, corners[i][0].data() + first), hn::Load(d, corners[i][1].data() + first),
                   hn::Load(d, corners[i][2].data() + first));
  }
  HWY_INLINE Triangle moved(const Isometry3d& X) const {
    const Matrix3d R = X.linear();
    const Vector3d t = X.translation();
    Triangle result;
    for (int i = 0; i < 3; ++i) {
      V q[3];
      for (int k = 0; k < 3; ++k)
        q[k] = hn::MulAdd(p[i].x, real(R(k, 0)),
                          hn::MulAdd(p[i].y, real(R(k, 1)), hn::MulAdd(p[i].z, real(R(k, 2)), real(t[k]))));
      result.p[i] = Point(q[0], q[1], q[2]);
    }
    return result;
  }

  Point p[3];
};

/// One vector of pairs: A, and B at both ends.
struct Pairs {
  HWY_INLINE Pairs(const TrianglePairs& pairs, const EndPoses& poses, int first) : a(pairs.a, first) {
    const Triangle in_b(pairs.b, first);
    start = in_b.moved(poses.X_AB_start);
    end = in_b.moved(poses.X_AB_end);
  }
  HWY_INLINE Triangle middle() const {
    Triangle t;
    for (int i = 0; i < 3; ++i) t.p[i] = halfway(start.p[i], end.p[i]);
    return t;
  }

  Triangle a, start, end;
};

/// The largest gap found so far, and its axis.
struct Best {
  V gap;
  Point axis;

  HWY_INLINE Best() : gap(real(-1e300)), axis(real(0.0), real(0.0), real(1.0)) {}

  /// The gap of B beyond A along the axis, or (`both`) against it.
  HWY_INLINE void offer(const Pairs& pairs, const Point& direction, bool both) {
    const V length2 = dot(direction, direction);
    const M sound = hn::Gt(length2, real(1e-250));
    const V inverse = hn::Div(real(1.0), hn::Sqrt(hn::IfThenElse(sound, length2, real(1.0))));
    const Point n = scaled(direction, inverse);
    const V a[3] = {dot(n, pairs.a.p[0]), dot(n, pairs.a.p[1]), dot(n, pairs.a.p[2])};
    const V s[3] = {dot(n, pairs.start.p[0]), dot(n, pairs.start.p[1]), dot(n, pairs.start.p[2])};
    const V e[3] = {dot(n, pairs.end.p[0]), dot(n, pairs.end.p[1]), dot(n, pairs.end.p[2])};
    const V beyond = hn::Sub(hn::Min(least(s[0], s[1], s[2]), least(e[0], e[1], e[2])), most(a[0], a[1], a[2]));
    update(hn::And(sound, hn::Gt(beyond, gap)), beyond, n);
    if (!both) return;
    const V before = hn::Sub(least(a[0], a[1], a[2]), hn::Max(most(s[0], s[1], s[2]), most(e[0], e[1], e[2])));
    update(hn::And(sound, hn::Gt(before, gap)), before, scaled(n, real(-1.0)));
  }

  HWY_INLINE void load(int first, const TrianglePairs& pairs) {
    gap = hn::Load(d, pairs.gap.data() + first);
    axis = Point(hn::Load(d, pairs.axis[0].data() + first), hn::Load(d, pairs.axis[1].data() + first),
                 hn::Load(d, pairs.axis[2].data() + first));
  }

  HWY_INLINE void store(int first, TrianglePairs& pairs) const {
    hn::Store(gap, d, pairs.gap.data() + first);
    hn::Store(axis.x, d, pairs.axis[0].data() + first);
    hn::Store(axis.y, d, pairs.axis[1].data() + first);
    hn::Store(axis.z, d, pairs.axis[2].data() + first);
  }

 private:
  HWY_INLINE void update(M which, V value, const Point& n) {
    gap = hn::IfThenElse(which, value, gap);
    axis = selected(which, n, axis);
  }
};

/// The shortest displacement found so far from A to B.
struct Shortest {
  V distance2;
  Point displacement;

  HWY_INLINE Shortest() : distance2(real(1e300)), displacement(real(0.0), real(0.0), real(0.0)) {}

  HWY_INLINE void offer(M which, const Point& other) {
    const V other2 = dot(other, other);
    const M nearer = hn::And(which, hn::Lt(other2, distance2));
    distance2 = hn::IfThenElse(nearer, other2, distance2);
    displacement = selected(nearer, other, displacement);
  }
};

HWY_INLINE V clamped(V x) {
  return hn::Min(hn::Max(x, real(0.0)), real(1.0));
}
/// 1 / x; 0 if x is tiny.
HWY_INLINE V inverseOf(V x) {
  const M sound = hn::Gt(x, real(1e-280));
  return hn::IfThenElseZero(sound, hn::Div(real(1.0), hn::IfThenElse(sound, x, real(1.0))));
}

/// An edge, with precomputed values for its closest points.
struct Edge {
  HWY_INLINE Edge() {}  // as Point()
  HWY_INLINE Edge(const Point& p, const Point& q)
      : from(p), direction(q - p), length2(dot(direction, direction)), inverse2(inverseOf(length2)) {}

  Point from, direction;
  V length2, inverse2;
};

/// The same algorithm as closestPoints().
HWY_INLINE Point betweenEdges(const Edge& a, const Edge& b) {
  const Point w = a.from - b.from;
  const V uv = dot(a.direction, b.direction), uw = dot(a.direction, w), vw = dot(b.direction, w);
  const V determinant = hn::MulSub(a.length2, b.length2, hn::Mul(uv, uv));
  const V s0 = clamped(hn::Mul(hn::MulSub(uv, vw, hn::Mul(b.length2, uw)), inverseOf(determinant)));
  const V t = clamped(hn::Mul(hn::MulAdd(uv, s0, vw), b.inverse2));
  const V s = clamped(hn::Mul(hn::MulSub(uv, t, uw), a.inverse2));
  return along(along(Point(hn::Neg(w.x), hn::Neg(w.y), hn::Neg(w.z)), t, b.direction), hn::Neg(s), a.direction);
}

/// Offers the displacements between a triangle's face and the other's corners, where their projections lie in the face.
/// @param sign  of the displacement.
HWY_INLINE void offerFace(const Triangle& face, const Triangle& corners, double sign, Shortest& best) {
  const Point ab = face.p[1] - face.p[0], ac = face.p[2] - face.p[0], normal = cross(ab, ac);
  const V area2 = dot(normal, normal), inverse = inverseOf(area2);
  const Point to_v = cross(ac, normal), to_w = cross(normal, ab);
  for (const Point& p : corners.p) {
    const Point ap = p - face.p[0];
    const V v = hn::Mul(dot(ap, to_v), inverse), w = hn::Mul(dot(ap, to_w), inverse);
    const V height = hn::Mul(dot(ap, normal), inverse);
    const M within = hn::And(hn::And(hn::Ge(v, real(0.0)), hn::Ge(w, real(0.0))), hn::Le(hn::Add(v, w), real(1.0)));
    best.offer(hn::And(within, hn::Gt(area2, real(1e-280))), scaled(normal, hn::Mul(height, real(sign))));
  }
}

/// Offers the planes through the triangle's edges, across its face.
/// @param sign  of the directions away from the triangle.
HWY_INLINE void offerEdges(const Pairs& pairs, const Triangle& t, double sign, Best& best) {
  const Point normal = scaled(cross(t.p[1] - t.p[0], t.p[2] - t.p[0]), real(sign));
  for (int i = 0; i < 3; ++i) best.offer(pairs, cross(t.p[(i + 1) % 3] - t.p[i], normal), false);
}

void planeGapsOf(const EndPoses& poses, const Vector3d& direction, TrianglePairs& pairs) {
  for (int first = 0; first < pairs.size; first += static_cast<int>(hn::Lanes(d))) {
    const Pairs all(pairs, poses, first);
    Best best;
    best.offer(all, Point(direction), false);
    best.offer(all, cross(all.a.p[1] - all.a.p[0], all.a.p[2] - all.a.p[0]), true);
    const Triangle middle = all.middle();
    best.offer(all, cross(middle.p[1] - middle.p[0], middle.p[2] - middle.p[0]), true);
    best.store(first, pairs);
  }
}

void closestGapsOf(const EndPoses& poses, TrianglePairs& pairs) {
  for (int first = 0; first < pairs.size; first += static_cast<int>(hn::Lanes(d))) {
    const Pairs all(pairs, poses, first);
    const Triangle middle = all.middle();
    Edge edges_b[3];
    for (int k = 0; k < 3; ++k) edges_b[k] = Edge(middle.p[k], middle.p[(k + 1) % 3]);
    const M always = hn::Eq(real(0.0), real(0.0));
    Shortest nearest;
    for (int i = 0; i < 3; ++i) {
      const Edge edge_a(all.a.p[i], all.a.p[(i + 1) % 3]);
      for (int k = 0; k < 3; ++k) nearest.offer(always, betweenEdges(edge_a, edges_b[k]));
    }
    offerFace(all.a, middle, 1.0, nearest);
    offerFace(middle, all.a, -1.0, nearest);
    Best best;
    best.offer(all, nearest.displacement, false);
    best.store(first, pairs);
    hn::Store(nearest.distance2, d, pairs.distance2.data() + first);
  }
}

void edgeGapsOf(const EndPoses& poses, TrianglePairs& pairs) {
  for (int first = 0; first < pairs.size; first += static_cast<int>(hn::Lanes(d))) {
    const Pairs all(pairs, poses, first);
    Best best;
    best.load(first, pairs);
    offerEdges(all, all.a, 1.0, best);
    offerEdges(all, all.middle(), -1.0, best);
    best.store(first, pairs);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sdf_ccd {

HWY_EXPORT(planeGapsOf);
HWY_EXPORT(closestGapsOf);
HWY_EXPORT(edgeGapsOf);

void planeGaps(const EndPoses& poses, const Vector3d& direction_A, TrianglePairs& pairs) {
  HWY_DYNAMIC_DISPATCH(planeGapsOf)(poses, direction_A, pairs);
}

void closestGaps(const EndPoses& poses, TrianglePairs& pairs) {
  HWY_DYNAMIC_DISPATCH(closestGapsOf)(poses, pairs);
}

void edgeGaps(const EndPoses& poses, TrianglePairs& pairs) {
  HWY_DYNAMIC_DISPATCH(edgeGapsOf)(poses, pairs);
}

}  // namespace sdf_ccd
#endif
