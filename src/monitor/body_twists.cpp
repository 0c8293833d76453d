#include "body_twists.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "motion/two_body_motion.h"
#include "pose_rounding.h"

namespace sdf_ccd {

namespace {

/// 1 + 2 cos(1/8), rounded up: the trace of a rotation by 1/8 rad.
constexpr double kTrace = 2.9845;

/// Factor that makes a double's rounding to float an upper bound of it; leaves room for a few more roundings.
constexpr double kUp = 1.0 + 0x1p-22;

/// Relative error of a scan in single precision, for a body's rotation (times a distance) and for its velocity:
/// scanPairs() needs 15 u and 7 u with u = 2^-24, and the series of Twist::small() 6 u more.
constexpr double kNoise = 0x1p-19;  // 32 u

/// Lengths below this have squares that underflow in single precision.
constexpr double kMin = 1e-18;  // [m]

/// Bitwise equality.
bool same(const Isometry3d& a, const Isometry3d& b) {
  const auto bits = [](const Isometry3d& X, int i) {
    std::uint64_t value;
    std::memcpy(&value, X.data() + i, sizeof value);
    return value;
  };
  std::uint64_t differ = 0;
  for (int i = 0; i < 16; ++i) differ |= bits(a, i) ^ bits(b, i);
  return differ == 0;
}

/// Upper bound of the norm, without a square root.
double normUpperBound(const Vector3d& v) {
  return v.lpNorm<1>();
}

/// Upper bound of poseDefect(), without a square root.
double defectUpperBound(const Isometry3d& X_WB) {
  const auto column = [&](int k) { return X_WB.matrix().col(k).head<3>(); };
  const auto product = [&](int i, int k) { return std::abs(column(i).dot(column(k)) - (i == k ? 1.0 : 0.0)); };
  return product(0, 0) + product(1, 1) + product(2, 2) + 2.0 * (product(0, 1) + product(1, 2) + product(2, 0)) +
         kPoseRoundings * kPoseEpsilon;
}

}  // namespace

/// Motion over a step, in double precision.
///
/// Let θ = |ω| and Δ the displacement of the ball's centre, with parts Δ_∥ along the axis and Δ_⊥ across it.
/// The centre moves on an arc of radius ρ and angle θ with the chord |Δ_⊥| = 2 ρ sin(θ/2). The chord's middle m
/// is ρ cos(θ/2) from the axis, so its velocity is Δ_∥ + (θ/2) cot(θ/2) Δ_⊥.
struct BodyTwists::Twist {
  Vector3d omega = Vector3d::Zero(), velocity = Vector3d::Zero(), point_W = Vector3d::Zero();
  double reach = 0.0;        // as TwistRow::kReach
  double shift = 0.0;        // bound of the centre's distance from m
  double turn_noise = 0.0;   // error of the rotation, from the poses
  double shift_noise = 0.0;  // error of the displacement, from the rounding of coordinates

  /// By series, for θ < 1/8, so that sin²θ < 0.0156.
  ///
  /// θ / sin θ = asin(s)/s = 1 + s²/6 + 3 s⁴/40 + 5 s⁶/112 + …; the relative error of truncation is below
  /// 2e-9.
  ///  (θ/2) cot(θ/2) = 1 − θ²/12 − θ⁴/720 − …; the truncated terms are below 4e-7 of Δ_⊥, and θ²
  /// Δ_⊥ = −ω × (ω × Δ).
  ///  The arc's middle is ρ (1 − cos(θ/2)) = ½ |Δ_⊥| tan(θ/4) < 0.016 |Δ| from m, and the centre's mean
  /// distance from the arc's middle is at most a quarter of its path, which is at most 1.0007 |Δ| long.
  static Twist small(const Vector3d& half_cross, const Vector3d& start, const Vector3d& end, double radius) {
    const double s2 = half_cross.squaredNorm();
    const Vector3d shift = end - start;
    Twist twist;
    twist.omega = (1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (5.0 / 112.0)))) * half_cross;
    twist.velocity = shift + (1.0 / 12.0) * twist.omega.cross(twist.omega.cross(shift));
    twist.point_W = 0.5 * (start + end);
    twist.shift = shift.norm();
    twist.reach = radius + 0.27 * twist.shift;
    return twist;
  }

  /// By logarithm, about the ball's centre at s = ½. @throws std::exception if a pose is not a rigid transform.
  static Twist large(const Isometry3d& X_start, const Isometry3d& X_end, const BoundingBall& ball) {
    const WorldTwist exact = worldTwist(ScrewMotion(X_start, X_end), ball);
    Twist twist;
    twist.omega = exact.omega;
    twist.velocity = exact.velocity;
    twist.point_W = exact.center;
    twist.shift = exact.velocity.norm();
    twist.reach = ball.radius + 0.2501 * twist.shift;
    return twist;
  }
};

BodyTwists::BodyTwists(const Scene& scene)
    : scene_(scene),
      stride_((scene.bodies.size() + kTwistLanes - 1) / kTwistLanes * kTwistLanes),
      rows_(stride_ * static_cast<std::size_t>(TwistRow::kCount), 0.0F),
      bodies_(scene.bodies.size()),
      is_open_(scene.bodies.size(), 0) {
  std::vector<int> pairs(scene.bodies.size(), 0);
  for (const PlannedPair& pair : scene.pairs)
    for (const int body : {pair.body_a, pair.body_b}) ++pairs[static_cast<std::size_t>(body)];
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    is_open_[b] = !ballContainsBody(scene.bodies[b]);
    lose(b);
    if (pairs[b] == 0 || !scene.bodies[b].failure.empty()) continue;
    if (paired_.empty() || pairs[b] > pairs[anchor_]) anchor_ = b;
    paired_.push_back(b);
  }
}

void BodyTwists::forget() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    lose(b);
    bodies_[b].is_known = bodies_[b].began = false;
  }
}

void BodyTwists::take(const BodyTwists& other, const std::vector<BodyRun>& bodies) {
  origin_ = other.origin_;
  for (Followed& body : bodies_) body.rests = false;
  for (const BodyRun& run : bodies) {
    std::copy_n(other.bodies_.begin() + static_cast<std::ptrdiff_t>(run.from), run.count,
                bodies_.begin() + static_cast<std::ptrdiff_t>(run.to));
    for (int row = 0; row < static_cast<int>(TwistRow::kCount); ++row) {
      const float* from = other.row(static_cast<TwistRow>(row));
      std::copy_n(from + run.from, run.count, &at(static_cast<TwistRow>(row), run.to));
    }
  }
}

double BodyTwists::displacement(int body, const BodyTwists& other, int other_body) const {
  const auto b = static_cast<std::size_t>(body);
  const Followed &from = bodies_[b], &to = other.bodies_[static_cast<std::size_t>(other_body)];
  if (from.is_known && to.is_known && same(from.X_WB, to.X_WB)) return 0.0;
  if (!from.is_known || !to.is_known || is_open_[b]) return std::numeric_limits<double>::infinity();
  const BoundingBall& ball = scene_.bodies[b].ball;
  const double far = normUpperBound(from.X_WB.translation()) + normUpperBound(to.X_WB.translation()) +
                     normUpperBound(ball.center) + ball.radius;
  return kUp * maxDisplacement(from.X_WB, to.X_WB, ball) + (from.defect + to.defect) * ball.radius + 0x1p-48 * far;
}

void BodyTwists::lose(std::size_t b) {
  for (int row = 0; row < static_cast<int>(TwistRow::kCount); ++row)
    at(static_cast<TwistRow>(row), b) = std::numeric_limits<float>::quiet_NaN();
  bodies_[b].is_followed = bodies_[b].rests = false;
}

void BodyTwists::begin(const CycleMotion& motion, const std::vector<char>& is_whole) {
  for (const std::size_t b : paired_) {
    Followed& body = bodies_[b];
    const bool is_there = is_whole[b] && (motion.missing.empty() || motion.missing[b].empty());
    body.began = is_there && body.is_known && same(motion.X_WB[b].front(), body.X_WB);
    if (!body.began) {
      if (body.is_followed) lose(b);
      continue;
    }
    body.is_followed = true;
    const double motion_error = motion.motion_error.empty() ? 0.0 : motion.motion_error[b];
    const bool same_error = motion_error == body.motion_error;
    if (body.rests && same_error && same(motion.pose(b, 1), body.X_WB)) continue;
    body.rests = false;
    body.motion_error = motion_error;
    body.tilt = body.defect;
    body.rounding = poseRounding(body.X_WB);
    body.farthest = 0.0;
    step(b, motion.pose(b, 1));
  }
}

void BodyTwists::step(const CycleMotion& motion, std::size_t k) {
  for (const std::size_t b : paired_)
    if (bodies_[b].is_followed) step(b, motion.pose(b, k + 1));
}

void BodyTwists::step(std::size_t b, const Isometry3d& X_WB) {
  if (same(X_WB, bodies_[b].X_WB)) {
    rest(b);
  } else {
    move(b, X_WB);
  }
}

void BodyTwists::end(const CycleMotion& motion, const std::vector<char>& is_whole) {
  for (const std::size_t b : paired_) {
    Followed& body = bodies_[b];
    if (body.is_followed) continue;
    body.is_known = false;
    if (is_whole[b] && (motion.missing.empty() || motion.missing[b].empty())) enter(b, motion.X_WB[b].back());
    body.is_known = body.is_known && body.X_WB.linear().determinant() > 0.0;
  }
  chooseOrigin();
}

/// Places the origin near the body with most pairs: there coordinates are small, and so is their rounding in single
/// precision.
void BodyTwists::chooseOrigin() {
  constexpr double kNear = 1.0;  // [m]
  if (paired_.empty() || !bodies_[anchor_].is_known) return;
  const Vector3d& center = bodies_[anchor_].center_W;
  if ((center - origin_).squaredNorm() < kNear * kNear) return;
  origin_ = center;
  for (Followed& body : bodies_) body.rests = false;
}

/// Sets the pose of a body. @return whether it can be followed.
bool BodyTwists::enter(std::size_t b, const Isometry3d& X_WB) {
  Followed& body = bodies_[b];
  constexpr double kDefect = 0.9e-6;  // ScrewMotion takes a little more
  body.X_WB = X_WB;
  body.center_W = X_WB * scene_.bodies[b].ball.center;
  body.defect = defectUpperBound(X_WB);
  // False for NaN too, which makes the centre NaN. end() excludes reflections, where a body is not yet followed.
  body.is_known = body.defect < kDefect && X_WB.translation().cwiseAbs().maxCoeff() <= kFarthestPose &&
                  normUpperBound(body.center_W) < std::numeric_limits<double>::infinity();
  return body.is_known;
}

void BodyTwists::rest(std::size_t b) {
  Followed& body = bodies_[b];
  if (body.rests) return;
  Twist twist;
  twist.point_W = body.center_W;
  twist.reach = scene_.bodies[b].ball.radius;
  write(b, twist);
  at(TwistRow::kTurnNoise, b) = at(TwistRow::kShiftNoise, b) = 0.0F;
  body.rests = true;  // farthest, tilt and rounding of an earlier step remain, which are not smaller
}

void BodyTwists::move(std::size_t b, const Isometry3d& X_WB) {
  Followed& body = bodies_[b];
  const BoundingBall& ball = scene_.bodies[b].ball;
  const Isometry3d X_start = body.X_WB;
  const Vector3d start = body.center_W;
  body.rests = false;
  if (!enter(b, X_WB)) return lose(b);

  const auto R = X_start.linear(), Q = X_WB.linear();
  Vector3d cross = Vector3d::Zero();  // 2 sin θ along the axis
  for (int k = 0; k < 3; ++k) cross += R.col(k).cross(Q.col(k));
  Twist twist;
  if (R.cwiseProduct(Q).sum() > kTrace) {
    twist = Twist::small(0.5 * cross, start, body.center_W, ball.radius);
  } else {
    try {
      twist = Twist::large(X_start, X_WB, ball);
    } catch (const std::exception&) {
      return lose(b);
    }
  }
  body.tilt = std::max(body.tilt, body.defect);
  body.rounding = std::max(body.rounding, poseRounding(X_WB));
  twist.turn_noise = 16.0 * body.tilt;  // bound for cross products of rotations that are not exactly orthonormal
  twist.shift_noise = 0x1p-48 * (normUpperBound(X_start.translation()) + normUpperBound(X_WB.translation()) +
                                 normUpperBound(ball.center));
  write(b, twist);
}

void BodyTwists::write(std::size_t b, const Twist& twist) {
  Followed& body = bodies_[b];
  const auto up = [](double x) { return static_cast<float>(kUp * x); };
  const Vector3d point = twist.point_W - origin_;
  for (int k = 0; k < 3; ++k) {
    at(TwistRow::kOmega, b, k) = static_cast<float>(twist.omega[k]);
    at(TwistRow::kVelocity, b, k) = static_cast<float>(twist.velocity[k]);
    at(TwistRow::kPoint, b, k) = static_cast<float>(point[k]);
  }
  const double far = normUpperBound(point) + twist.reach + twist.shift + normUpperBound(scene_.bodies[b].ball.center);
  body.farthest = std::max(body.farthest, far);
  at(TwistRow::kReach, b) = up(twist.reach);
  at(TwistRow::kOpen, b) = is_open_[b] ? std::numeric_limits<float>::infinity() : 0.0F;
  at(TwistRow::kTurnNoise, b) = up(kNoise * normUpperBound(twist.omega) + twist.turn_noise);
  at(TwistRow::kShiftNoise, b) = up(kNoise * normUpperBound(twist.velocity) + twist.shift_noise + kMin);
  at(TwistRow::kFar, b) = up(far);
  at(TwistRow::kFarthest, b) = up(body.farthest);
  // The motion error of a half-space holds within kHalfSpaceRadius and grows in proportion to the distance beyond.
  const double stray = is_open_[b] && body.motion_error > 0.0 ? body.motion_error / kHalfSpaceRadius : 0.0;
  at(TwistRow::kTilt, b) = up(body.tilt + stray);
  at(TwistRow::kError, b) = up(body.rounding + body.motion_error);
}

const Isometry3d& BodyTwists::last(const CycleMotion& motion, int body) const {
  const auto b = static_cast<std::size_t>(body);
  return bodies_[b].began ? motion.X_WB[b].front() : bodies_[b].X_WB;
}

double BodyTwists::poseError(int body_a, int body_b) const {
  const auto sum = [&](TwistRow which) {
    const float* values = row(which);
    return double(values[body_a]) + double(values[body_b]);
  };
  return sum(TwistRow::kTilt) * sum(TwistRow::kFarthest) + sum(TwistRow::kError);
}

}  // namespace sdf_ccd
