#pragma once

#include <cstddef>
#include <vector>

#include "common/compiler_lanes.h"
#include "sdf_ccd/scene.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// Data of a body that a scan over pairs reads, in single precision, for one step between two recorded times. Bounds
/// are rounded up. All values are NaN for a body that is not followed.
enum class TwistRow {
  kOmega,                  ///< rotation vector in world axes, three rows [rad]
  kVelocity = kOmega + 3,  ///< of the reference point, per step, three rows [m]
  kPoint = kVelocity + 3,  ///< the reference point relative to origin(), three rows [m]
  kReach = kPoint + 3,     ///< bound of the mean distance of a point of the ball from the reference point [m]
  kOpen,                   ///< 0; infinite if the body's ball does not contain it
  kPath,                   ///< bound of the path of a point of the body in the step, without noise [m]
  kTurnNoise,              ///< rounding error of the rotation: times a distance, it is one of a displacement [rad]
  kShiftNoise,             ///< further rounding error of a displacement [m]
  kFar,                    ///< bound of the distance of the ball and of the body's frame origin from origin() [m]
  kFarthest,               ///< largest kFar in the cycle up to now [m]
  kTilt,                   ///< error of the cycle's poses, relative to a distance
  kError,                  ///< further error of its poses and motion [m]
  kCount
};

/// The bodies in so many consecutive slots are a group, stored together: the values of a row, then those of the next.
constexpr std::size_t kTwistLanes = lanes::kFloatWidth;
constexpr std::size_t kTwistBlock = kTwistLanes * static_cast<std::size_t>(TwistRow::kCount);

/// Where a slot's first row is in BodyTwists::rows(); the others follow at distances of kTwistLanes.
constexpr std::size_t twistOffset(std::size_t slot) {
  return slot / kTwistLanes * kTwistBlock + slot % kTwistLanes;
}
constexpr std::size_t twistGroup(std::size_t slot) {
  return slot / kTwistLanes;
}

/// The largest values of a group's bodies while all of them with pairs rest.
struct TwistGroup {
  bool rests = false;  ///< in the step, all with the same motion error; the others are valid only then
  float far = 0.0F, farthest = 0.0F, tilt = 0.0F, error = 0.0F;  ///< as TwistRow
  float swing = 0.0F;                                            ///< of a body's tilt times its `farthest` [m]
};

struct TwistLanes;

/// The twists of a scene's bodies, computed once per step for all pairs.
///
/// A body is followed if its motion starts at the pose at which the last cycle ended. A body at rest (bitwise equal
/// poses) costs a comparison. Each step is a constant twist in the world, about a reference point m.
class BodyTwists {
 public:
  explicit BodyTwists(const Scene& scene);

  /// Begins a cycle with its first step, from time 0 to time 1.
  /// @param is_whole  per body: whether its poses at all times may be read.
  void begin(const CycleMotion& motion, const std::vector<char>& is_whole);

  /// Computes the step from time k to time k + 1; to be called for k = 1, 2, … in this order.
  void step(const CycleMotion& motion, std::size_t k);

  /// Ends the cycle. A body that was not followed will be in the next one, if its poses are whole and can be followed.
  void end(const CycleMotion& motion, const std::vector<char>& is_whole);

  /// Discards the bodies' poses.
  void forget();

  /// Takes over the bodies' data from another scene between two cycles, without allocating. All other bodies keep their
  /// poses. @param before  per body: its index in the other scene; −1 if it is not there.
  void adopt(const BodyTwists& other, const std::vector<int>& before);

  /// Upper bound of the displacement of a body's points from its pose here to that in another scene [m], where it has
  /// the index `other_body`; infinite if one of the poses is not known.
  double displacement(int body, const BodyTwists& other, int other_body) const;

  /// Where a body is stored. The world's bodies have groups of their own, which rest most of the time.
  std::size_t slot(int body) const { return slots_[static_cast<std::size_t>(body)]; }

  /// The values of all bodies: see twistOffset().
  const float* rows() const { return rows_.data(); }
  const TwistGroup* groups() const { return groups_.data(); }

  /// The pose of a body at the end of the last cycle, if that was whole. Valid between begin() and end().
  const Isometry3d& last(const CycleMotion& motion, int body) const;

  /// Upper bound of the error of a pair's distance from poses and motions in this cycle [m]; NaN if one of the bodies
  /// is not followed.
  double poseError(int body_a, int body_b) const;

 private:
  struct Followed {
    Isometry3d X_WB = Isometry3d::Identity();  // at the end of the last step
    Vector3d center_W = Vector3d::Zero();      // centre of the ball at X_WB [m]
    double defect = 0.0;                       // poseDefect() of X_WB, rounded up
    double tilt = 0.0, rounding = 0.0;         // largest of the cycle
    double farthest = 0.0;                     // largest TwistRow::kFar of the cycle [m]
    double motion_error = 0.0;                 // [m]
    bool is_known = false;                     // X_WB can be followed
    bool began = false;                        // it was followed at the cycle's start
    bool is_followed = false;
    bool rests = false;  // its rows are those of a body at rest, and stay valid while it rests
  };
  struct Twist;

  bool enter(std::size_t body, const Isometry3d& X_WB);
  bool enter(std::size_t body, const Isometry3d& X_WB, const TwistLanes& twists, std::size_t lane);
  void rest(std::size_t body);
  void move(const CycleMotion& motion, std::size_t k);
  void move(std::size_t body, const Isometry3d& X_WB, const TwistLanes& twists, std::size_t lane);
  void write(std::size_t body, const Twist& twist);
  void lose(std::size_t body);
  void endRest();
  void summariseGroups();
  void chooseOrigin();
  float& at(TwistRow row, std::size_t body, int offset = 0) {
    return rows_[twistOffset(slots_[body]) +
                 (static_cast<std::size_t>(row) + static_cast<std::size_t>(offset)) * kTwistLanes];
  }

  const Scene& scene_;
  std::vector<std::size_t> slots_;         // per body
  std::vector<std::ptrdiff_t> paired_in_;  // per slot: a body with pairs; -1 if there is none
  std::vector<float> rows_;
  std::vector<TwistGroup> groups_;
  std::vector<Followed> bodies_;
  std::vector<std::size_t> paired_;     // bodies with pairs that can be checked
  std::vector<std::size_t> moving_;     // of these, those that move in the step
  std::vector<char> is_open_;           // per body: its ball does not contain it
  std::size_t anchor_ = 0;              // the body with most pairs
  Vector3d origin_ = Vector3d::Zero();  // [m]
};

}  // namespace sdf_ccd
