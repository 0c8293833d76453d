#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/pi.h"
#include "oracle/random.h"
#include "precision/random_inputs.h"
#include "segment_cases.h"
#include "shell_system.h"

namespace sdf_ccd::benchmark {

/// Fixed sets of random motions of a shell near a field.
///
/// random: both poses anywhere in a box three times as large as the field's (paper, Table 3). The other motions are
/// those of a control cycle, 1 % of the field's side and half a degree. small: into contact, starting at most half of
/// that before it. deep: the bodies' centres are within a tenth of the side. clear: their bounding balls are apart.
/// links: anywhere in a box as large as the field's, about its centre.
class MotionCases {
 public:
  explicit MotionCases(const ShellSubject& subject)
      : subject_(subject),
        side_(studyBox(subject.field_mesh).sizes().x()),
        shell_side_(studyBox(subject.shell_mesh).sizes().x()),
        center_F_(studyBox(subject.field_mesh).center()),
        center_P_(studyBox(subject.shell_mesh).center()) {}

  std::vector<PosePair> pairs(const std::string& name, std::size_t count) const {
    test::Random random(20140924);
    std::vector<PosePair> pairs;
    while (pairs.size() < count) pairs.push_back(pair(name, random));
    return pairs;
  }

 private:
  PosePair pair(const std::string& name, test::Random& random) const {
    const Matrix3d R = precision::rotation(random);
    if (name == "random") {
      const Isometry3d start = pose(R, offset(random, 1.5));
      return {start, pose(precision::rotation(random), offset(random, 1.5))};
    }
    const Vector3d u = test::direction(random);
    if (name == "small") {
      const double gap = test::uniform(random, 0.0, 0.5 * kTravel) * side_;
      return moved(pose(R, (touching(R, u) + gap) * u), -kTravel * side_ * u, random);
    }
    const Vector3d travel = kTravel * side_ * test::direction(random);
    if (name == "clear") {
      // Half a cube's diagonal is 0.87 of its side.
      return moved(pose(R, test::uniform(random, 0.9, 1.5) * (side_ + shell_side_) * u), travel, random);
    }
    return moved(pose(R, offset(random, name == "deep" ? 0.1 : 0.5)), travel, random);
  }

  Vector3d offset(test::Random& random, double half_box) const {
    return half_box * side_ * test::pointInCube(random, 1.0);
  }

  /// Pose with the shell's centre at `offset` from the field's.
  Isometry3d pose(const Matrix3d& R, const Vector3d& offset) const {
    Isometry3d X_FP = Isometry3d::Identity();
    X_FP.linear() = R;
    X_FP.translation() = center_F_ + offset - R * center_P_;
    return X_FP;
  }

  PosePair moved(const Isometry3d& start, const Vector3d& travel, test::Random& random) const {
    const Vector3d middle = start * center_P_;
    Isometry3d turn = Isometry3d::Identity();
    turn.linear() = Eigen::AngleAxisd(kTurn, test::direction(random)).toRotationMatrix();
    turn.translation() = middle + travel - turn.linear() * middle;
    return {start, turn * start};
  }

  /// Distance of the centres along u at which a shell that approaches from far away first touches the field's surface.
  double touching(const Matrix3d& R, const Vector3d& u) const {
    const double step = 0.05 * side_;
    for (double distance = 1.5 * (side_ + shell_side_); distance > 0.0; distance -= step) {
      const ChordPath path{{{0.0, 1.0, pose(R, distance * u), pose(R, (distance - step) * u), 0}}, 0.0};
      ShellQueryResult result;
      shellIntervals(subject_.field, subject_.shell, subject_.tree, path, result);
      double first = result.inside.empty() ? 2.0 : 0.0;
      for (const ShellHit& hit : result.hits) first = std::min(first, hit.interval.enter);
      if (first <= 1.0) return distance - first * step;
    }
    return 0.0;
  }

  static constexpr double kTravel = 0.01;           ///< of the field's side
  static constexpr double kTurn = 0.5 * kPi / 180;  ///< [rad]

  ShellSubject subject_;
  double side_, shell_side_;
  Vector3d center_F_, center_P_;
};

}  // namespace sdf_ccd::benchmark
