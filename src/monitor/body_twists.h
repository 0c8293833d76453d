#pragma once

#include <cstddef>
#include <vector>

#include "common/compiler_lanes.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/motion/cycle_motion.h"

namespace sdf_ccd {

/// What a scan over pairs reads of a body, in single precision, for one step from a recorded time to the next; all NaN
/// of a body that is not followed. Bounds are rounded up.
enum class TwistRow {
  kOmega,                  ///< rotation, and two rows more [rad], world axes
  kVelocity = kOmega + 3,  ///< of the reference point, and two rows more [m]
  kPoint = kVelocity + 3,  ///< the reference point, from origin(), and two rows more [m]
  kReach = kPoint + 3,     ///< no point of the ball is farther from the reference point, on average over the step [m]
  kOpen,                   ///< 0; infinite of a body that its ball does not hold
  kTurnNoise,              ///< what rounding adds to the rotation: times a distance, to a displacement [rad]
  kShiftNoise,             ///< what it adds to a displacement besides [m]
  kFar,                    ///< neither the ball nor the body's own origin reaches farther from origin() [m]
  kFarthest,               ///< the same over the cycle up to now [m]
  kTilt,                   ///< of the cycle's poses: times a distance, their error
  kError,                  ///< of its poses and motion besides [m]
  kCount
};

/// Bodies in a row are a multiple of this.
constexpr std::size_t kTwistLanes = lanes::kFloatWidth;

/// Bodies of one scene that stand in a row in another one too.
struct BodyRun {
  std::size_t to, from, count;
};

/// How bodies move, each worked out once a step, for all of its pairs.
///
/// Followed are bodies whose motion goes on where it ended the cycle before; what is bitwise at rest costs a
/// comparison. Each step is taken as a constant twist, as everywhere, about a reference point m.
class BodyTwists {
 public:
  explicit BodyTwists(const Scene& scene);

  /// Begins a cycle with its first step, from time 0 to time 1.
  /// @param is_whole  per body: whether its poses at all times may be read.
  void begin(const CycleMotion& motion, const std::vector<char>& is_whole);

  /// Works out the step from time k to time k + 1; in turn from k = 1.
  void step(const CycleMotion& motion, std::size_t k);

  /// Ends the cycle: what was not followed will be in the next one, if its poses are whole and can be.
  void end(const CycleMotion& motion, const std::vector<char>& is_whole);

  /// Forgets where bodies were.
  void forget();

  /// Takes over what is known of bodies between two cycles, without allocating.
  void take(const BodyTwists& other, const std::vector<BodyRun>& bodies);

  /// By body, stride() of them.
  const float* row(TwistRow row) const { return rows_.data() + static_cast<std::size_t>(row) * stride_; }
  std::size_t stride() const { return stride_; }

  /// Where a body was at the end of the last cycle, if that was whole; between begin() and end().
  const Isometry3d& last(const CycleMotion& motion, int body) const;

  /// Bound of what poses and motions add to the error of a pair's distance in this cycle [m]; NaN if one of the bodies
  /// is not followed.
  double poseError(int body_a, int body_b) const;

 private:
  struct Followed {
    Isometry3d X_WB = Isometry3d::Identity();  // at the end of the last step, or cycle
    Vector3d center_W = Vector3d::Zero();      // of the ball there [m]
    double defect = 0.0;                       // poseDefect() there
    double tilt = 0.0, rounding = 0.0;         // the largest of the cycle
    double farthest = 0.0;                     // of the cycle [m]
    double motion_error = 0.0;                 // [m]
    bool is_known = false;                     // X_WB is a pose that can be followed
    bool began = false;                        // it was followed at the cycle's start
    bool is_followed = false;
    bool rests = false;  // its rows say so, and hold as long as it does
  };
  struct Twist;

  bool enter(std::size_t body, const Isometry3d& X_WB);
  void step(std::size_t body, const Isometry3d& X_WB);
  void rest(std::size_t body);
  void move(std::size_t body, const Isometry3d& X_WB);
  void write(std::size_t body, const Twist& twist);
  void lose(std::size_t body);
  void chooseOrigin();
  float& at(TwistRow row, std::size_t body, int offset = 0) {
    return rows_[(static_cast<std::size_t>(row) + static_cast<std::size_t>(offset)) * stride_ + body];
  }

  const Scene& scene_;
  std::size_t stride_;
  std::vector<float> rows_;
  std::vector<Followed> bodies_;
  std::vector<std::size_t> paired_;     // bodies with pairs that can be checked
  std::vector<char> is_open_;           // per body: its ball does not hold it
  std::size_t anchor_ = 0;              // the one with most pairs
  Vector3d origin_ = Vector3d::Zero();  // [m]
};

}  // namespace sdf_ccd
