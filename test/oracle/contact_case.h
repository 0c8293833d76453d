#pragma once

#include <cmath>
#include <vector>

#include "contact/penalty.h"
#include "oracle/shapes.h"
#include "shell/point_shell.h"

namespace sdf_ccd::test {

inline Isometry3d translation(const Vector3d& p) {
  return Isometry3d(Eigen::Translation3d(p));
}

inline Isometry3d pose(const Vector3d& p, double angle, const Vector3d& axis) {
  return Eigen::Translation3d(p) * Eigen::AngleAxisd(angle, axis.normalized());
}

/// Points in a spiral on a sphere, all of the same area, at equal steps in z, so that sums over z are midpoint sums.
inline PointShell spiralSphere(double radius, int count) {
  PointShell shell;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, turn = kPi * (3.0 - std::sqrt(5.0)) * i;
    const double r = std::sqrt(1.0 - z * z);
    const Vector3d normal(r * std::cos(turn), r * std::sin(turn), z);
    shell.add(radius * normal, normal, static_cast<float>(4.0 * kPi * radius * radius / count));
  }
  return shell;
}

/// The face [-half, half]² at z = 0 of a body above it, as count × count points.
inline PointShell bottomFace(double half, int count) {
  PointShell shell;
  const double side = 2.0 * half / count;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < count; ++k)
      shell.add({-half + (i + 0.5) * side, -half + (k + 0.5) * side, 0.0}, -Vector3d::UnitZ(),
                static_cast<float>(side * side));
  }
  return shell;
}

inline PointShell onePoint(const Vector3d& p, const Vector3d& normal) {
  PointShell shell;
  shell.add(p, normal, 1.0F);
  return shell;
}

/// One shell against one field over chords; every point is tested.
struct ContactCase {
  DistanceField field;
  PointShell shell;
  ChordPath path;
  std::vector<Isometry3d> X_CF = {Isometry3d::Identity(), Isometry3d::Identity()};
  std::vector<SiblingField> siblings = {};

  std::vector<ShellHit> hits() const {
    std::vector<ShellHit> hits;
    for (std::size_t c = 0; c < path.chords.size(); ++c) {
      const Chord& chord = path.chords[c];
      for (std::size_t i = 0; i < shell.size(); ++i) {
        const Segment segment{chord.X_FP_start * shell.point(i), chord.X_FP_end * shell.point(i)};
        for (const Interval& interval : segmentIntervals(field, segment))
          hits.push_back({static_cast<int>(i), static_cast<int>(c), interval});
      }
    }
    return hits;
  }

  ContactImpulse run(const ContactOptions& options, const ContactRequest& request = {}) const {
    ContactImpulse result;
    integrateContact({field, shell, path, X_CF, siblings}, hits(), options, request, result);
    return result;
  }
};

inline ChordPath oneChord(double duration, const Isometry3d& X_FP_start, const Isometry3d& X_FP_end) {
  return {{{0.0, duration, X_FP_start, X_FP_end, 0}}, 0.0};
}

constexpr double kStiffness = 1e7;  // [N/m^3]

inline ContactOptions perArea() {
  ContactOptions options;
  options.stiffness = kStiffness;
  return options;
}

inline Primitive ground() {
  return HalfSpace{Vector3d::UnitZ(), 0.0};
}

}  // namespace sdf_ccd::test
