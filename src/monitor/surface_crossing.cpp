#include "surface_crossing.h"

#include <algorithm>
#include <cmath>

#include "geometry/triangle.h"
#include "query/surfaces/triangle_pair.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

/// Walks along one point's path, starting where it meets the field's surface.
class PointWalk {
 public:
  PointWalk(const DistanceField& field, const ChordPath& path, const Vector3d& p_P, double path_error)
      : field_(field), path_(path), p_P_(p_P), path_error_(path_error) {}

  /// Whether the walk reaches a point that is certainly outside (side 1) or inside (−1) without passing near a cap.
  /// @param s  start position on the chord, from 0 to 1.
  /// @param direction  of time, 1 or −1.
  bool reaches(int side, int chord, double s, int direction) {
    setChord(chord);
    constexpr int kMaxSteps = 64;
    for (int i = 0; i < kMaxSteps; ++i) {
      const Vector3d p = start_ + s * way_;
      const FieldSample sample = field_.sample(p);
      const double error = sample.error + path_error_, beyond = side * sample.value;
      if (beyond > error) return true;
      // A step of this length stays farther than the path's error from all caps.
      const double room = 0.9 * (field_.openingDistance(p) - path_error_);
      if (!(room > 0.0)) return false;
      if (!advance(std::min(room, std::max(error - beyond, 0.25 * error)), direction, chord, s)) return false;
    }
    return false;
  }

 private:
  void setChord(int chord) {
    start_ = path_.chords[chord].X_FP_start * p_P_;
    way_ = path_.chords[chord].X_FP_end * p_P_ - start_;
    length_ = way_.norm();
  }

  /// Advances by `step` [m], at most to the chord's end; false at the path's end.
  bool advance(double step, int direction, int& chord, double& s) {
    const double end = direction > 0 ? 1.0 : 0.0;
    if (s != end) {
      s += direction * step / std::max(length_, 1e-300);
      if (direction * (end - s) < 0.0) s = end;
      return true;
    }
    chord += direction;
    if (chord < 0 || chord == static_cast<int>(path_.chords.size())) return false;
    setChord(chord);
    s = 1.0 - end;
    return true;
  }

  const DistanceField& field_;
  const ChordPath& path_;
  const Vector3d p_P_;
  const double path_error_;
  Vector3d start_, way_;
  double length_ = 0.0;
};

/// Whether a ball of A may meet a surface of B, according to B's fields.
bool mayMeet(const Body& b, const Vector3d& center_B, double radius) {
  return std::any_of(b.parts.begin(), b.parts.end(), [&](const BodyPart& part) {
    const DistanceBounds bounds = part.field.bounds(part.X_BG.inverse() * center_B);
    return bounds.low <= radius && bounds.high >= -radius;
  });
}

/// A point at which the surfaces of two bodies cross.
struct SurfaceCrossing {
  Vector3d p_B;       // on B's surface [m]
  Vector3d normal_B;  // of B's triangle there, unit
};

/// @param a, b  B must have fields, which select the triangles of A that come near.
std::optional<SurfaceCrossing> surfacesCross(const Body& a, const Body& b, const Isometry3d& X_BA, double pose_error) {
  if (!a.surface || !b.surface) return std::nullopt;
  // Includes the rounding of coordinates and of a pose between them.
  const auto reach = [](const Body& body) { return body.ball.center.norm() + body.ball.radius; };
  const double size = reach(a) + reach(b) + X_BA.translation().norm();
  const double error = pose_error + a.surface->deviation + b.surface->deviation + 1e-12 * size;
  constexpr int kMaxTests = 100000;
  int tests = 0;
  CancelTicks<> cancel;
  std::optional<SurfaceCrossing> found;
  const auto done = [&] { return found || tests > kMaxTests; };
  const auto test = [&](const Corners& t_A, int triangle_b) {
    ++tests;
    const Corners t_B = cornersOf(b.surface->mesh, triangle_b);
    const std::optional<Vector3d> p_B = crossingPoint(t_A, t_B, error);
    if (p_B) found = {*p_B, areaNormal(t_B).normalized()};
  };
  const auto near_b = [&](const Vector3d& center_A, double radius) {
    cancel.check();
    return !done() && mayMeet(b, X_BA * center_A, radius);
  };
  a.surface->tree.forEachTriangle(near_b, [&](int triangle_a) {
    Corners t_A = cornersOf(a.surface->mesh, triangle_a);
    for (Vector3d& p : t_A) p = X_BA * p;
    const auto near_a = [&](const Vector3d& center_B, double radius) {
      cancel.check();
      return !done() && (closestOnTriangle(t_A, center_B) - center_B).norm() <= radius;
    };
    b.surface->tree.forEachTriangle(near_a, [&](int triangle_b) { test(t_A, triangle_b); });
  });
  return found;
}

}  // namespace

bool passesThroughMesh(const DistanceField& field, const ChordPath& path, const Vector3d& p_P, const ShellHit& hit,
                       double path_error) {
  PointWalk walk(field, path, p_P, path_error);
  const auto [enter, exit] = hit.interval;
  return (enter > 0.0 && walk.reaches(1, hit.chord, enter, -1) && walk.reaches(-1, hit.chord, enter, 1)) ||
         (exit < 1.0 && walk.reaches(1, hit.chord, exit, 1) && walk.reaches(-1, hit.chord, exit, -1));
}

std::optional<ContactPoint> crossingAtARecordedTime(const Scene& scene, const CycleMotion& motion,
                                                    const PairResult& pair, double pose_error) {
  const bool b_has_fields = !scene.bodies[pair.body_b].parts.empty();
  const int a = b_has_fields ? pair.body_a : pair.body_b, b = b_has_fields ? pair.body_b : pair.body_a;
  constexpr std::size_t kMaxTimes = 8;
  const WaypointSpan& span = pair.span;
  const std::size_t stride = (span.last - span.first) / kMaxTimes + 1;
  for (std::size_t back = 0; back <= span.last - span.first; back += stride) {
    const std::size_t waypoint = span.last - back;
    const Isometry3d &X_WA = motion.pose(a, waypoint), &X_WB = motion.pose(b, waypoint);
    const auto found = surfacesCross(scene.bodies[a], scene.bodies[b], relativePose(X_WB, X_WA), pose_error);
    if (!found) continue;
    ContactPoint contact;
    contact.enter = contact.exit = contact.time = motion.times[waypoint];
    contact.p_W = X_WB * found->p_B;
    contact.normal_W = (b_has_fields ? -1.0 : 1.0) * (X_WB.linear() * found->normal_B);
    return contact;
  }
  return std::nullopt;
}

bool isInsideUncertain(const Body& body) {
  return body.doubtful || std::any_of(body.parts.begin(), body.parts.end(),
                                      [](const BodyPart& part) { return part.field.openings() != nullptr; });
}

}  // namespace sdf_ccd
