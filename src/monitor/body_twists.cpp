#include "body_twists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "motion/two_body_motion.h"
#include "pose_rounding.h"
#include "twist_lanes.h"

namespace sdf_ccd {

namespace {

/// Factor that makes a double's rounding to float an upper bound of it; leaves room for a few more roundings.
constexpr double kUp = 1.0 + 0x1p-22;

/// Relative error of a scan in single precision, for a body's rotation (times a distance) and for its velocity:
/// scanPairs() needs 15 u and 7 u with u = 2^-24, and the series of computeTwists() 6 u more.
constexpr double kNoise = 0x1p-19;  // 32 u

/// Lengths below this have squares that underflow in single precision.
constexpr double kMin = 1e-18;  // [m]

using BitsInMemory __attribute__((vector_size(32), aligned(8), may_alias)) = std::int64_t;

/// The bits in which two poses differ, in any coordinate.
SDF_CCD_INLINE lanes::LongInts difference(const Isometry3d& a, const Isometry3d& b) {
  lanes::LongInts differ{};
  for (int i = 0; i < 16; i += 4)
    differ |=
        *reinterpret_cast<const BitsInMemory*>(a.data() + i) ^ *reinterpret_cast<const BitsInMemory*>(b.data() + i);
  return differ;
}

SDF_CCD_INLINE bool isZero(const lanes::LongInts& bits) {
  return (bits[0] | bits[1] | bits[2] | bits[3]) == 0;
}

/// Bitwise equality.
SDF_CCD_INLINE bool same(const Isometry3d& a, const Isometry3d& b) {
  return isZero(difference(a, b));
}

/// The next whole number of groups.
std::size_t roundedUp(std::size_t slots) {
  return (slots + kTwistLanes - 1) / kTwistLanes * kTwistLanes;
}

/// First the robot's bodies, then the world's, in the order of their indices.
std::vector<std::size_t> slotsOf(const BodyList& bodies) {
  const auto isOfWorld = [](const Body& body) { return body.is_world; };
  const auto robots = bodies.size() - static_cast<std::size_t>(std::count_if(bodies.begin(), bodies.end(), isOfWorld));
  std::size_t robot = 0, world = roundedUp(robots);
  std::vector<std::size_t> slots;
  for (const Body& body : bodies) slots.push_back(body.is_world ? world++ : robot++);
  return slots;
}

/// Upper bound of the norm, without a square root.
double normUpperBound(const Vector3d& v) {
  return v.lpNorm<1>();
}

}  // namespace

/// Motion over a step, in double precision.
struct BodyTwists::Twist {
  Vector3d omega = Vector3d::Zero(), velocity = Vector3d::Zero(), point_W = Vector3d::Zero();
  double reach = 0.0;        // as TwistRow::kReach
  double turn = 0.0;         // amount of omega
  double shift = 0.0;        // bound of the centre's distance from m, and of the velocity's amount
  double turn_noise = 0.0;   // error of the rotation, from the poses
  double shift_noise = 0.0;  // error of the displacement, from the rounding of coordinates

  /// For θ < 1/8. The arc's middle is ρ (1 − cos(θ/2)) = ½ |Δ_⊥| tan(θ/4) < 0.016 |Δ| from m, and the centre's mean
  /// distance from the arc's middle is at most a quarter of its path, which is at most 1.0007 |Δ| long.
  static Twist small(const TwistLanes& twists, std::size_t lane, double radius) {
    Twist twist;
    twist.omega = TwistLanes::at(twists.omega, lane);
    twist.velocity = TwistLanes::at(twists.velocity, lane);
    twist.point_W = TwistLanes::at(twists.point_W, lane);
    twist.turn = twists.turn[lane];
    twist.shift = twists.shift[lane];
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
    twist.turn = exact.omega.norm();
    twist.shift = exact.velocity.norm();
    twist.reach = ball.radius + 0.2501 * twist.shift;
    return twist;
  }
};

BodyTwists::BodyTwists(const Scene& scene)
    : scene_(scene),
      slots_(slotsOf(scene.bodies)),
      paired_in_(slots_.empty() ? 0 : roundedUp(*std::max_element(slots_.begin(), slots_.end()) + 1), -1),
      rows_(paired_in_.size() / kTwistLanes * kTwistBlock, 0.0F),
      groups_(paired_in_.size() / kTwistLanes),
      bodies_(scene.bodies.size()),
      is_open_(scene.bodies.size(), 0) {
  std::vector<int> pairs(scene.bodies.size(), 0);
  for (const PlannedPair& pair : scene.pairs)
    for (const int body : {pair.body_a, pair.body_b}) ++pairs[static_cast<std::size_t>(body)];
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    is_open_[b] = !scene.bodies[b].half_spaces.empty();
    lose(b);
    if (pairs[b] > 0) paired_in_[slots_[b]] = static_cast<std::ptrdiff_t>(b);
    if (pairs[b] == 0 || !scene.bodies[b].failure.empty()) continue;
    if (paired_.empty() || pairs[b] > pairs[anchor_]) anchor_ = b;
    paired_.push_back(b);
  }
  moving_.reserve(paired_.size());
}

void BodyTwists::forget() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    lose(b);
    bodies_[b].is_known = bodies_[b].began = false;
  }
}

void BodyTwists::adopt(const BodyTwists& other, const std::vector<int>& before) {
  origin_ = other.origin_;
  endRest();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (before[b] < 0) continue;
    const auto known = static_cast<std::size_t>(before[b]);
    bodies_[b] = other.bodies_[known];
    const float* from = other.rows() + twistOffset(other.slots_[known]);
    float* to = rows_.data() + twistOffset(slots_[b]);
    for (std::size_t row = 0; row < kTwistBlock; row += kTwistLanes) to[row] = from[row];
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
  groups_[twistGroup(slots_[b])].rests = false;
}

/// Has the rows of all bodies written in the next step.
void BodyTwists::endRest() {
  for (Followed& body : bodies_) body.rests = false;
  for (TwistGroup& group : groups_) group.rests = false;
}

/// Finds the groups that rest now. Writing a body's rows ends its group's rest.
void BodyTwists::summariseGroups() {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (groups_[g].rests) continue;
    TwistGroup group{true};
    const Followed* first = nullptr;
    for (std::size_t slot = g * kTwistLanes; slot < (g + 1) * kTwistLanes && group.rests; ++slot) {
      if (paired_in_[slot] < 0) continue;
      const auto b = static_cast<std::size_t>(paired_in_[slot]);
      if (first == nullptr) first = &bodies_[b];
      group.rests = bodies_[b].rests && bodies_[b].motion_error == first->motion_error;
      group.far = std::max(group.far, at(TwistRow::kFar, b));
      group.farthest = std::max(group.farthest, at(TwistRow::kFarthest, b));
      group.tilt = std::max(group.tilt, at(TwistRow::kTilt, b));
      group.swing = std::max(group.swing, at(TwistRow::kTilt, b) * at(TwistRow::kFarthest, b));
      group.error = std::max(group.error, at(TwistRow::kError, b));
    }
    groups_[g] = group;
  }
}

SDF_CCD_LANES void BodyTwists::begin(const CycleMotion& motion, const std::vector<char>& is_whole) {
  for (const std::size_t b : paired_) {
    Followed& body = bodies_[b];
    const bool is_there = is_whole[b] && (motion.missing.empty() || motion.missing[b].empty());
    const double motion_error = motion.motion_error.empty() ? 0.0 : motion.motion_error[b];
    const bool rested = is_there && body.rests && body.is_followed && motion_error == body.motion_error;
    if (rested && isZero(difference(motion.X_WB[b].front(), body.X_WB) | difference(motion.pose(b, 1), body.X_WB))) {
      body.began = true;
      continue;
    }
    body.began = is_there && body.is_known && same(motion.X_WB[b].front(), body.X_WB);
    if (!body.began) {
      if (body.is_followed) lose(b);
      continue;
    }
    body.is_followed = true;
    const bool stays = same(motion.pose(b, 1), body.X_WB);
    body.rests = false;
    body.motion_error = motion_error;
    body.tilt = body.defect;
    body.rounding = poseRounding(body.X_WB);
    body.farthest = 0.0;
    if (stays) {
      rest(b);
    } else {
      moving_.push_back(b);
    }
  }
  move(motion, 0);
  summariseGroups();
}

SDF_CCD_LANES void BodyTwists::step(const CycleMotion& motion, std::size_t k) {
  for (const std::size_t b : paired_) {
    if (!bodies_[b].is_followed) continue;
    if (same(motion.pose(b, k + 1), bodies_[b].X_WB)) {
      rest(b);
    } else {
      moving_.push_back(b);
    }
  }
  move(motion, k);
  summariseGroups();
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
  endRest();
}

/// Sets the pose of a body. @return whether it can be followed.
bool BodyTwists::enter(std::size_t b, const Isometry3d& X_WB, const TwistLanes& twists, std::size_t lane) {
  Followed& body = bodies_[b];
  constexpr double kDefect = 0.9e-6;  // ScrewMotion takes a little more
  body.X_WB = X_WB;
  body.center_W = TwistLanes::at(twists.center_W, lane);
  body.defect = twists.defect[lane] + kPoseRoundings * kPoseEpsilon;
  // False for NaN too, which makes the centre NaN. end() excludes reflections, where a body is not yet followed.
  body.is_known = body.defect < kDefect && X_WB.translation().cwiseAbs().maxCoeff() <= kFarthestPose &&
                  normUpperBound(body.center_W) < std::numeric_limits<double>::infinity();
  return body.is_known;
}

bool BodyTwists::enter(std::size_t b, const Isometry3d& X_WB) {
  const BodyStep stays{&X_WB, &X_WB, &scene_.bodies[b].ball};
  TwistLanes twists;
  computeTwists({stays, stays, stays, stays}, twists);
  return enter(b, X_WB, twists, 0);
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

/// Moves the bodies in `moving_` over the step from time k to time k + 1.
void BodyTwists::move(const CycleMotion& motion, std::size_t k) {
  TwistLanes twists;
  std::array<BodyStep, TwistLanes::kCount> steps;
  for (std::size_t first = 0; first < moving_.size(); first += steps.size()) {
    const std::size_t count = std::min(steps.size(), moving_.size() - first);
    for (std::size_t lane = 0; lane < steps.size(); ++lane) {
      const std::size_t b = moving_[first + std::min(lane, count - 1)];
      steps[lane] = {&bodies_[b].X_WB, &motion.pose(b, k + 1), &scene_.bodies[b].ball};
    }
    computeTwists(steps, twists);
    for (std::size_t lane = 0; lane < count; ++lane) move(moving_[first + lane], *steps[lane].end, twists, lane);
  }
  moving_.clear();
}

void BodyTwists::move(std::size_t b, const Isometry3d& X_WB, const TwistLanes& twists, std::size_t lane) {
  Followed& body = bodies_[b];
  const BoundingBall& ball = scene_.bodies[b].ball;
  body.rests = false;
  Twist twist;
  if (twists.trace[lane] > TwistLanes::kTrace) {
    twist = Twist::small(twists, lane, ball.radius);
    if (!enter(b, X_WB, twists, lane)) return lose(b);
  } else {
    const Isometry3d X_start = body.X_WB;
    if (!enter(b, X_WB, twists, lane)) return lose(b);
    try {
      twist = Twist::large(X_start, X_WB, ball);
    } catch (const std::exception&) {
      return lose(b);
    }
  }
  body.tilt = std::max(body.tilt, body.defect);
  body.rounding = std::max(body.rounding, poseRounding(X_WB));
  twist.turn_noise = 16.0 * body.tilt;  // bound for cross products of rotations that are not exactly orthonormal
  twist.shift_noise = 0x1p-48 * twists.coordinates[lane];
  write(b, twist);
}

void BodyTwists::write(std::size_t b, const Twist& twist) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Followed& body = bodies_[b];
  groups_[twistGroup(slots_[b])].rests = false;
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
  at(TwistRow::kOpen, b) = is_open_[b] ? kInfinity : 0.0F;
  at(TwistRow::kPath, b) = is_open_[b] ? kInfinity : up(twist.shift + twist.turn * twist.reach);
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
  const float *a = rows() + twistOffset(slot(body_a)), *b = rows() + twistOffset(slot(body_b));
  const auto sum = [&](TwistRow row) {
    const std::size_t at = static_cast<std::size_t>(row) * kTwistLanes;
    return double(a[at]) + double(b[at]);
  };
  return sum(TwistRow::kTilt) * sum(TwistRow::kFarthest) + sum(TwistRow::kError);
}

}  // namespace sdf_ccd
