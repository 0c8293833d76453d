// The motion of a cycle between recorded transforms, compared with tf2's own interpolation.

#include <gtest/gtest.h>
#include <tf2/buffer_core.h>

#include <random>

#include "ros/tf/tf_tracker.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::tf_motion_test {

using test::message;
using test::stampedTransform;
using Step = TfTracker::Step;

struct Joint {
  std::string parent, child;
  Vector3d axis, offset;
  double rate;   // [rad/s]
  double slide;  // along the offset [1/s]
};

class Motion {
 public:
  Motion(const std::vector<Joint>& joints, double tolerance) : joints_(joints) {
    std::vector<TrackedBody> bodies;
    std::vector<PlannedPair> pairs;
    for (const Joint& joint : joints) {
      bodies.push_back({joint.child, Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.1)), {{0.4, 0.0, 0.0}, 0.4}});
      pairs.push_back({static_cast<int>(pairs.size()), static_cast<int>(joints.size()), true, true});
    }
    bodies.push_back({"world", Isometry3d::Identity(), {Vector3d::Zero(), 1.0}});
    TfTrackerOptions options;
    options.sampling.tolerance = tolerance;
    tracker_ = std::make_unique<TfTracker>(history_, bodies, pairs, options);
    bodies_ = bodies;
  }

  /// Sends the poses of all joints at a time plus each joint's offset.
  void send(double time, const std::vector<double>& offsets) {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint& joint = joints_[j];
      const double at = time + offsets[j];
      const auto sent =
          stampedTransform(joint.parent, joint.child, ros::Time(at),
                           Quaterniond(Eigen::AngleAxisd(joint.rate * (at - 10.0), joint.axis.normalized())),
                           joint.offset * (1.0 + joint.slide * (at - 10.0)));
      history_.add(message({sent}), false);
      buffer_.setTransform(sent, "test");
    }
    step_ = tracker_->next(ros::Time(time + 0.05), cycle_);
  }

  /// Compares the deviation of each body's points from its screw between samples, with the body moved by tf2, with the
  /// reported error. Both arguments receive maxima.
  void expectErrorsHold(double& largest_error, double& largest_true) const {
    constexpr int kDense = 40;
    const CycleMotion& motion = cycle_.motion;
    for (std::size_t body = 0; body < joints_.size(); ++body) {
      ASSERT_EQ(motion.missing[body], "");
      double worst = 0.0;
      for (std::size_t k = motion.span(body).first; k < motion.span(body).last; ++k) {
        const ScrewMotion screw(motion.X_WB[body][k], motion.X_WB[body][k + 1]);
        for (int i = 0; i <= kDense; ++i) {
          const double share = double(i) / kDense;
          const double time = motion.times[k] + share * (motion.times[k + 1] - motion.times[k]);
          const Isometry3d X_WB = poseOf(body, cycle_.origin + ros::Duration(time));
          const Isometry3d X_screw = screw.pose(share);
          for (const Vector3d& p : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.8, 0.0, 0.0), Vector3d(0.4, 0.4, 0.0),
                                    Vector3d(0.4, 0.0, 0.4), Vector3d(0.4, 0.0, -0.4)}) {
            worst = std::max(worst, (X_WB * p - X_screw * p).norm());
          }
        }
      }
      EXPECT_LE(worst, motion.motion_error[body] + 1e-8) << bodies_[body].frame;  // stamps are in nanoseconds
      largest_error = std::max(largest_error, motion.motion_error[body]);
      largest_true = std::max(largest_true, worst);
    }
  }

  Step step() const { return step_; }
  const TrackedCycle& cycle() const { return cycle_; }

 private:
  Isometry3d poseOf(std::size_t body, const ros::Time& time) const {
    return toTfPose({}, buffer_.lookupTransform("world", bodies_[body].frame, time).transform).isometry() *
           bodies_[body].X_frame_B;
  }

  std::vector<Joint> joints_;
  std::vector<TrackedBody> bodies_;
  TfHistory history_{"world"};
  tf2::BufferCore buffer_;
  std::unique_ptr<TfTracker> tracker_;
  TrackedCycle cycle_;
  Step step_ = Step::kWaiting;
};

TEST(TfMotion, ErrorHoldsForArmsThatAllTurn) {
  const Vector3d z = Vector3d::UnitZ(), y = Vector3d::UnitY(), x = Vector3d::UnitX();
  for (const double rate : {10.0, 50.0}) {
    for (const double tolerance : {1.0, 1e-4}) {  // without halving, and with
      Motion motion({{"world", "base", z, {0.2, 0.0, 0.0}, 0.0, 0.5},
                     {"base", "left", z, {0.0, 0.8, 0.0}, 2.0, 0.0},
                     {"left", "left_hand", y, {0.8, 0.0, 0.0}, -2.0, 0.3},
                     {"base", "right", z, {0.0, -0.8, 0.0}, -2.0, 0.0},
                     {"right", "right_hand", x, {0.8, 0.0, 0.0}, 2.0, 0.0}},
                    tolerance);
      double error = 0.0, deviation = 0.0;
      for (int i = 0; i < 12; ++i) {
        motion.send(10.0 + double(i) / rate, {0.0, 0.001, 0.004, 0.006, 0.008});
        if (motion.step() == Step::kCycle) motion.expectErrorsHold(error, deviation);
      }
      EXPECT_GT(deviation, tolerance == 1.0 ? (rate == 10.0 ? 3e-3 : 1e-4) : 0.0);
      EXPECT_LT(error, tolerance == 1.0 ? 100.0 * deviation : tolerance) << rate << " Hz";
    }
  }
}

TEST(TfMotion, ErrorHoldsForRandomTrees) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int tree = 0; tree < 60; ++tree) {
    std::vector<Joint> joints;
    for (int j = 0; j < 5; ++j) {
      const int parent = static_cast<int>(uniform(random) * (j + 1)) - 1;
      joints.push_back({parent < 0 ? "world" : "link" + std::to_string(parent), "link" + std::to_string(j),
                        Vector3d(normal(random), normal(random), normal(random)),
                        0.5 * Vector3d(normal(random), normal(random), normal(random)),
                        uniform(random) < 0.3 ? 0.0 : 4.0 * normal(random), uniform(random) < 0.5 ? 0.0 : 1.0});
    }
    Motion motion(joints, tree % 2 == 0 ? 1.0 : 1e-3);
    const double period = 0.02 + 0.15 * uniform(random);
    double error = 0.0, deviation = 0.0;
    for (int i = 0; i < 6; ++i) {
      std::vector<double> offsets;
      for (int j = 0; j < 5; ++j) offsets.push_back(0.9 * period * uniform(random));
      motion.send(10.0 + i * period, offsets);
      if (motion.step() == Step::kCycle) motion.expectErrorsHold(error, deviation);
    }
  }
}

TEST(TfMotion, TimesWithARecordedTransformBetweenThemHaveNoBound) {
  TfHistory history("world");
  history.add(message({stampedTransform("world", "hand", 10.0, 0.0), stampedTransform("world", "hand", 10.1, 1.0),
                       stampedTransform("world", "hand", 10.2, 1.5)}),
              false);
  TfWindow window;
  TfChains chains({"hand"});
  history.copy(chains, {{ros::Time(10.0), ros::Time(10.2)}}, ros::Time(10.0), window);
  const auto speed = [&](double start, double end) { return window.derivatives(0, 0.0, start, end).first; };
  EXPECT_NEAR(speed(0.0, 0.1), 1.0, 1e-12);
  EXPECT_NEAR(speed(0.12, 0.17), 0.25, 1e-7);
  EXPECT_EQ(speed(0.05, 0.15), std::numeric_limits<double>::infinity());
}

}  // namespace sdf_ccd::tf_motion_test
