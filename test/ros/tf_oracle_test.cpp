// Wherever the history knows a pose, tf2's buffer knows the same one, whatever is sent; and as long as nodes follow the
// rules, the history knows a pose wherever tf2 does.

#include <gtest/gtest.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>

#include "oracle/rounds.h"
#include "ros/tf/tf_history.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::tf_oracle_test {

using test::message;
using test::stampedTransform;

constexpr int kFrames = 7;            // without the fixed one
constexpr double kKeep = 10.0;        // [s]
constexpr double kFarthest = 10.0;    // maximum distance of a frame from its parent [m]
constexpr double kOffUnit = 4.98e-3;  // of an accepted quaternion's length: its square is within 0.01 of 1

std::string frameName(int frame) {
  return frame == 0 ? "world" : "f" + std::to_string(frame);
}

double difference(const Isometry3d& X, const geometry_msgs::Transform& transform) {
  const auto& q = transform.rotation;
  const auto& p = transform.translation;
  const Isometry3d other = Eigen::Translation3d(p.x, p.y, p.z) * Quaterniond(q.w, q.x, q.y, q.z).normalized();
  return (X.matrix() - other.matrix()).cwiseAbs().maxCoeff();
}

/// Behaviour of publishers.
struct Habits {
  double late = 0.0;      // fraction of transforms that come late
  double latest = 0.9;    // maximum delay [s]
  double reparent = 0.0;  // fraction with another parent
  double bad = 0.0;       // fraction that is no rigid motion
  double stamps = 0.0;    // fraction with an arbitrary stamp
  double off_unit = 0.0;  // relative error of quaternions' lengths; tf2 gets unit ones all the same
};

class Duel {
 public:
  Duel(unsigned seed, const Habits& habits) : random_(seed), habits_(habits), fixed_(frameName(pick(kFrames + 1))) {
    history_ = std::make_unique<TfHistory>(fixed_, TfHistoryOptions{{}, kKeep});
    for (int frame = 1; frame <= kFrames; ++frame) {
      parents_[frame] = frameName(pick(frame));
      stamps_[frame] = std::make_unique<TfHistory>("parent");
      is_static_[frame] = chance(0.2);
      steps_[frame] = std::pow(10.0, uniform(-4.0, 0.5));  // rotation and translation per transform [rad, m]
      if (is_static_[frame]) send(frame, 0.0);
    }
  }

  void play(int messages) {
    for (int i = 0; i < messages; ++i) {
      now_ += uniform(0.0, chance(0.02) ? 4.0 : 0.05);
      for (int frame = 1; frame <= kFrames; ++frame) {
        if (is_static_[frame] || chance(0.3)) continue;
        send(frame, now_ - (chance(habits_.late) ? uniform(0.0, habits_.latest) : 0.0));
        if (chance(0.02)) send(frame, now_);  // a repeated stamp
      }
      for (int k = 0; k < 4; ++k) compare();
      if (::testing::Test::HasFailure()) return;
    }
  }

  long known() const { return known_; }
  long only_tf2_knows() const { return only_tf2_knows_; }
  double worst() const { return worst_; }

 private:
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  Vector3d vector() { return {uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)}; }

  void send(int frame, double seconds) {
    Quaterniond& q = rotations_[frame];
    Vector3d& p = translations_[frame];
    if (!chance(0.3)) {  // else it rests
      const Vector3d turn = steps_[frame] * vector();
      q = (q * Quaterniond(1.0, turn.x(), turn.y(), turn.z())).normalized();
      p = (p + steps_[frame] * vector()).cwiseMax(-kFarthest).cwiseMin(kFarthest);
    }
    Quaterniond sent_q = q;
    sent_q.coeffs() *= (chance(0.5) ? -1.0 : 1.0) * (1.0 + habits_.off_unit * uniform(-1.0, 1.0));
    Vector3d sent_p = p;
    if (chance(habits_.bad)) {
      const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300};
      if (chance(0.5)) {
        sent_q.coeffs() *= uniform(0.0, 0.98);  // tf2 accepts nearly unit ones unchanged
      } else {
        const double factor = bad[pick(3)];
        sent_p *= factor;
        is_huge_[frame] |= !std::isnan(factor);
      }
    }
    const std::string parent = chance(habits_.reparent) ? frameName(pick(kFrames + 1)) : parents_[frame];
    ros::Time stamp(std::max(0.0, seconds));
    if (chance(habits_.stamps)) stamp = ros::Time(static_cast<std::uint32_t>(random_()), pick(1000000000));
    if (chance(habits_.stamps)) stamp = ros::Time(std::max(0.0, seconds + uniform(-12.0, 1.0)));
    geometry_msgs::TransformStamped sent = stampedTransform(parent, frameName(frame), stamp, sent_q, sent_p);
    geometry_msgs::TransformStamped for_tf2 = sent;
    if (habits_.off_unit > 0.0)
      for_tf2 = stampedTransform(parent, frameName(frame), stamp, sent_q.normalized(), sent_p);
    takeByTf2(for_tf2, is_static_[frame]);
    if (chance(0.2)) sent.child_frame_id = "/" + sent.child_frame_id;
    history_->add(message({sent}), is_static_[frame]);
    sent.header.frame_id = "parent";
    stamps_[frame]->add(message({sent}), is_static_[frame]);
    went_back_[frame] |= stamps_[frame]->span(frameName(frame)).change.find("went back") != std::string::npos;
  }

  /// Leaves out stamps near the end of time: tf2 adds durations to stamps, which throws there.
  void takeByTf2(const geometry_msgs::TransformStamped& sent, bool is_static) {
    if (!is_static && sent.header.stamp.sec >= 1u << 31) return;
    if (!buffer_.setTransform(sent, "test", is_static) || is_static) return;
    came_[sent.child_frame_id].try_emplace(sent.header.stamp, sent.header.frame_id);
  }

  void compare() {
    const std::string frame = frameName(pick(kFrames + 1));
    const ros::Time time = aTime(frame);
    Isometry3d X;
    std::string problem;
    const bool is_known = history_->lookup(frame, time, X, problem);
    try {
      const geometry_msgs::Transform expected = buffer_.lookupTransform(fixed_, frame, time).transform;
      if (is_known && isComparable(frame, time)) {
        ++known_;
        worst_ = std::max(worst_, difference(X, expected));
        ASSERT_LT(difference(X, expected), 1e-11) << frame << " in " << fixed_;
      }
      only_tf2_knows_ += !is_known;
      last_problem_ = is_known ? last_problem_ : problem;
    } catch (const tf2::TransformException& error) {
      ASSERT_TRUE(!is_known || frame == fixed_ || !isComparable(frame, time))
          << frame << " in " << fixed_ << " at " << time << ": " << error.what();
    }
  }

  /// A random time, or one at, just before or just after a stamp.
  ros::Time aTime(const std::string& frame) {
    if (chance(0.1)) return ros::Time();
    const auto& came = came_[frame];
    if (came.empty() || chance(0.5)) return ros::Time(std::max(0.0, now_ - uniform(-0.1, chance(0.5) ? 0.3 : 12.0)));
    auto stamp = came.lower_bound(ros::Time(now_ - uniform(0.0, 1.0)));
    if (stamp == came.end()) --stamp;
    const int shift = pick(3) - 1;
    return shift < 0 && stamp->first > ros::Time(1.0) ? stamp->first - ros::Duration(0, 1)
           : shift > 0                                ? stamp->first + ros::Duration(0, 1)
                                                      : stamp->first;
  }

  /// tf2 lets the parent change with each transform, while the history begins with the last parent. Transforms from
  /// before stamps went back are not comparable either.
  bool isComparable(const std::string& frame, const ros::Time& time) {
    if (habits_.latest < 1.0 && habits_.reparent == 0.0 && habits_.stamps == 0.0) return true;
    if (time.isZero()) return false;
    for (const std::string& from : {frame, fixed_}) {
      std::vector<std::string> chain = history_->framesAbove(from);
      chain.insert(chain.begin(), from);
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const int number = chain[i] == "world" ? 0 : std::stoi(chain[i].substr(1));
        if (went_back_[number] || is_huge_[number]) return false;
        if (is_static_[number]) continue;
        const auto& came = came_[chain[i]];
        const auto after = came.lower_bound(time);
        if (after == came.end() || after->second != chain[i + 1]) return false;
        if (after->first != time && (after == came.begin() || std::prev(after)->second != chain[i + 1])) return false;
      }
    }
    return true;
  }

  std::mt19937_64 random_;
  Habits habits_;
  std::string fixed_;
  std::unique_ptr<TfHistory> history_;
  std::array<std::unique_ptr<TfHistory>, kFrames + 1> stamps_;  // of each frame alone
  tf2::BufferCore buffer_{ros::Duration(kKeep)};
  double now_ = 1000.0;
  std::array<std::string, kFrames + 1> parents_;
  std::array<bool, kFrames + 1> is_static_{}, went_back_{};
  std::array<bool, kFrames + 1> is_huge_{};  // tf2 goes via the root, and loses small lengths there
  std::array<double, kFrames + 1> steps_{};
  std::array<Quaterniond, kFrames + 1> rotations_ = filled(Quaterniond(Quaterniond::Identity()));
  std::array<Vector3d, kFrames + 1> translations_ = filled(Vector3d(Vector3d::Zero()));
  std::map<std::string, std::map<ros::Time, std::string>> came_;  // per frame: parents by the stamps that tf2 took
  long known_ = 0, only_tf2_knows_ = 0;
  double worst_ = 0.0;

 public:
  std::string last_problem_;

 private:
  template <class Value>
  static std::array<Value, kFrames + 1> filled(const Value& value) {
    std::array<Value, kFrames + 1> values;
    values.fill(value);
    return values;
  }
};

struct Tally {
  long known = 0, only_tf2_knows = 0;
  double worst = 0.0;
  std::string problem;
};

Tally duels(unsigned count, const Habits& habits) {
  Tally tally;
  for (unsigned seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Duel duel(seed, habits);
    duel.play(400);
    tally.known += duel.known();
    tally.only_tf2_knows += duel.only_tf2_knows();
    tally.worst = std::max(tally.worst, duel.worst());
    tally.problem = duel.last_problem_;
    if (::testing::Test::HasFailure()) break;
  }
  return tally;
}

TEST(TfOracle, KnowsWhatTf2KnowsOfNodesThatKeepToTheRules) {
  const Tally tally = duels(40, {0.2, 0.9});
  EXPECT_GT(tally.known, 10000);
  EXPECT_EQ(tally.only_tf2_knows, 0) << tally.problem;
  EXPECT_GT(tally.worst, 1e-16);
}

TEST(TfOracle, QuaternionsThatAreNearlyUnitAreThoseOfTf2Normalised) {
  const Tally tally = duels(20, {0.1, 0.9, 0.0, 0.0, 0.0, kOffUnit});
  EXPECT_GT(tally.known, 5000);
  EXPECT_EQ(tally.only_tf2_knows, 0) << tally.problem;
  EXPECT_GT(tally.worst, 1e-16);
}

/// What tf2 does with such a quaternion: it rotates p to |q|² R p, so that a frame below is off by ||q|² − 1| |p|.
TEST(TfOracle, Tf2ScalesWhatIsBelowAQuaternionThatIsNearlyUnit) {
  const Quaterniond q = Quaterniond(0.4, -0.3, 0.8, 0.1).normalized();
  const Vector3d p_12(3.0, -4.0, 12.0), p_01(1.0, 2.0, 3.0);
  for (const double length : {1.0 - kOffUnit, 1.0 - 1e-4, 1.0, 1.0 + 1e-6, 1.0 + 1e-3, 1.0 + kOffUnit, 1.006, 0.994}) {
    TfHistory history("world");
    tf2::BufferCore buffer;
    Quaterniond sent_q = q;
    sent_q.coeffs() *= length;
    for (const auto& sent : {stampedTransform("world", "f1", ros::Time(10.0), sent_q, p_01),
                             stampedTransform("f1", "f2", ros::Time(10.0), Quaterniond::Identity(), p_12)}) {
      history.add(message({sent}), false);
      buffer.setTransform(sent, "test");
    }
    Isometry3d X;
    std::string problem;
    const bool is_known = history.lookup("f2", ros::Time(10.0), X, problem);
    ASSERT_EQ(is_known, std::abs(length * length - 1.0) <= 0.01) << length << ": " << problem;
    if (!is_known) {
      EXPECT_THROW(buffer.lookupTransform("world", "f2", ros::Time(10.0)), tf2::TransformException) << length;
      continue;
    }
    EXPECT_LT((X.translation() - (p_01 + q * p_12)).norm(), 1e-14) << length;
    const auto& p = buffer.lookupTransform("world", "f2", ros::Time(10.0)).transform.translation;
    EXPECT_NEAR((Vector3d(p.x, p.y, p.z) - X.translation()).norm(), std::abs(length * length - 1.0) * p_12.norm(),
                1e-13)
        << length;
  }
}

TEST(TfOracle, NeverContradictsTf2WhateverIsSent) {
  long known = 0, only_tf2_knows = 0;
  for (const double reparent : {0.0, 0.02, 0.2}) {
    for (const double bad : {0.0, 0.05}) {
      const Tally tally = duels(test::rounds(60), {0.2, 3.0, reparent, bad, bad});
      known += tally.known;
      only_tf2_knows += tally.only_tf2_knows;
    }
  }
  EXPECT_GT(known, test::rounds(3000));
  EXPECT_GT(only_tf2_knows, test::rounds(1000));  // parents that changed, and transforms that are no rigid motion
}

/// Difference between tf2's and the history's interpolation of two poses, at a fraction of the time.
struct Pose {
  Quaterniond q;
  Vector3d p;
};

double differenceBetween(const Pose& a, const Pose& b, double share) {
  TfHistory history("world");
  tf2::BufferCore buffer;
  for (const auto& [stamp, pose] : {std::pair{10.0, a}, {11.0, b}}) {
    const auto sent = stampedTransform("world", "f1", ros::Time(stamp), pose.q, pose.p);
    history.add(message({sent}), false);
    buffer.setTransform(sent, "test");
  }
  const ros::Time time(10.0 + share);
  Isometry3d X;
  std::string problem;
  EXPECT_TRUE(history.lookup("f1", time, X, problem)) << problem;
  return difference(X, buffer.lookupTransform("world", "f1", time).transform);
}

TEST(TfOracle, HillClimbingFindsNoRotationsThatTf2InterpolatesOtherwise) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto near = [&](const Quaterniond& q, double step) {
    Quaterniond other(q.coeffs() +
                      step * Eigen::Vector4d(normal(random), normal(random), normal(random), normal(random)));
    return other.normalized();
  };
  double worst = 0.0;
  for (int climb = 0; climb < 60; ++climb) {
    Pose a{near(Quaterniond::Identity(), 10.0), Vector3d::Random()}, b{near(a.q, std::pow(10.0, -climb % 12)), a.p};
    double share = uniform(random), highest = 0.0;
    for (int step = 0; step < 250; ++step) {
      const double size = std::pow(10.0, -16.0 * uniform(random));
      Pose next = b;
      next.q = near(b.q, size);
      next.p += size * Vector3d(normal(random), normal(random), normal(random));
      const double next_share = std::min(std::max(share + size * normal(random), 0.0), 1.0);
      if (std::abs(a.q.dot(next.q)) < 1e-9) continue;  // half a revolution: both rotations are equally short
      const double height = differenceBetween(a, next, next_share);
      if (height < highest) continue;
      highest = height;
      b = next;
      share = next_share;
    }
    worst = std::max(worst, highest);
  }
  // tf2's arc cosine takes angles below 3e-8 between quaternions for 0 and keeps the first one.
  EXPECT_LT(worst, 1e-7);
  EXPECT_GT(worst, 1e-9);
}

}  // namespace sdf_ccd::tf_oracle_test
