// Plays transforms that come late, out of order, twice, on other topics, in another parent, or not at all, through a
// monitor's loop. The messages must not leave a time as CLEAR at which bodies really touched, according to this test's
// interpolation of all transforms that ever came.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>

#include "oracle/scene_case.h"
#include "ros/described_world.h"
#include "ros/messages/conversions.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::tf_disturbed_test {

using test::message;
using test::stampedTransform;
using Step = TfTracker::Step;

constexpr double kRadius = 0.05, kPlate = 0.45, kPlateHalf = 0.005;  // [m]
constexpr double kStep = 0.033, kLength = 6.0, kDense = 0.002;       // [s]
constexpr double kLatest = 1.5;                                      // maximum delay of a transform [s]
constexpr unsigned kEpisodes = 25;
constexpr double kTouch = 1e-5;  // bodies touch if they are deeper than this [m]

struct Sample {
  double stamp;
  Quaterniond rotation;
  Vector3d translation;
};

/// Transforms of a frame while it is published in one way.
struct Regime {
  std::string parent;
  bool is_static;
  std::map<double, Sample> came;  // by stamp; the first transform of each stamp
};

/// All transforms of a frame.
struct Publication {
  std::vector<Regime> regimes;

  /// None before the first known time, after the last one, and between two regimes of which the first moves.
  std::optional<Isometry3d> poseAt(double time, std::string& parent) const {
    const Regime* current = nullptr;
    for (const Regime& regime : regimes) {
      const bool is_after_static = current && current->is_static;
      const bool has_begun = regime.is_static ? !current || current->came.empty() || time > lastOf(*current)
                                              : !regime.came.empty() && time >= regime.came.begin()->first;
      if (regime.is_static && is_after_static) {
        const double changed = regime.came.begin()->first;  // the time of the change is not known
        if (time > changed - kLatest && time < changed) return std::nullopt;
        if (time < changed) break;
      }
      if (!has_begun) break;
      current = &regime;
    }
    if (!current || current->came.empty()) return std::nullopt;
    parent = current->parent;
    if (current->is_static) return isometry(current->came.begin()->second);
    const auto next = current->came.lower_bound(time);
    if (next == current->came.end()) return std::nullopt;
    if (next->first == time || next == current->came.begin()) return isometry(next->second);
    const Sample &a = std::prev(next)->second, &b = next->second;
    const double share = (time - a.stamp) / (b.stamp - a.stamp);
    return isometry({time, a.rotation.slerp(share, b.rotation), (1.0 - share) * a.translation + share * b.translation});
  }

  static double lastOf(const Regime& regime) { return regime.is_static ? -1.0 : regime.came.rbegin()->first; }
  static Isometry3d isometry(const Sample& sample) {
    return Eigen::Translation3d(sample.translation) * sample.rotation;
  }
};

std::shared_ptr<const Scene> scene() {
  BodyDescription hand = test::body("hand", Sphere{kRadius});
  hand.geometry[0].X_BG.translation().x() = 0.2;
  BodyDescription plate = test::body("plate", Box::fromSize({2.0 * kPlateHalf, 1.0, 1.0}), true);
  plate.geometry[0].X_BG.translation().x() = kPlate;
  static const auto built = test::build({hand, test::body("foot", Sphere{kRadius}), plate}, test::fine(0.004));
  return built;
}

class Episode {
 public:
  explicit Episode(unsigned seed) : random_(seed) {
    MonitorParameters parameters;
    parameters.monitor = test::soft();
    loop_ = std::make_unique<MonitorLoop>(scene(), test::describedWorld(), parameters);
    for (double& phase : phases_) phase = uniform(0.0, 6.3);
    rate_ = uniform(1.0, 5.0);
    delay_ = chance(0.3) ? 0.0 : uniform(0.0, 0.25);
    late_share_ = chance(0.5) ? 0.0 : uniform(0.0, 0.3);
    drop_share_ = chance(0.5) ? 0.0 : uniform(0.0, 0.3);
    for (const auto& [frame, period] : std::map<std::string, double>{{"base", 0.05}, {"arm", 0.02}, {"foot", 0.033}}) {
      Publisher publisher{frame, "world", period * uniform(0.5, 3.0), uniform(0.0, 0.02), uniform(0.0, delay_)};
      if (frame == "arm") publisher.parent = "base";
      publishers_.push_back(publisher);
      if (frame == "base" && chance(0.3)) {  // a second publisher
        publisher.next += 0.3 * publisher.period;
        publisher.delay = uniform(0.0, 0.4);
        publishers_.push_back(publisher);
      }
    }
    publishers_.push_back({"hand", "arm", 0.03, 0.005, uniform(0.0, delay_)});
    if (chance(0.5)) sendStatic(0.0);
  }

  void play() {
    for (double now = 0.0; now < kLength; now += kStep) {
      for (Publisher& publisher : publishers_) publish(publisher, now);
      if (chance(0.01)) changeHand(now);
      if (chance(0.004) && clock_runs_) jumpBack(now);
      if (chance(0.01)) publishers_[pick(publishers_.size())].silent_until = now + uniform(0.1, 1.5);
      deliver(now);
      step(now);
    }
    deliver(1e9);
    for (int i = 0; i < 30; ++i) {  // everything continues, in order
      const double now = kLength + 1.0 + i * kStep;
      for (const Publisher& publisher : publishers_) {
        if (publisher.frame != "hand" || !hand_is_static_) come({now, now, publisher.frame, publisher.parent});
      }
      step(now);
    }
  }

  void expectNoContactLeftClear() {
    for (double time = -kLength; time < kLength; time += kDense) {
      const bool is_claimed = isLeftClear(time);
      clear_times_ += is_claimed;
      const std::vector<std::optional<double>> depths = trueDepths(time);
      for (std::size_t pair = 0; pair < depths.size(); ++pair) {
        if (!depths[pair] || *depths[pair] <= kTouch) continue;
        ASSERT_FALSE(isLeftClear(pair, time))
            << "pair " << pair << " at " << time << " s, " << *depths[pair] << " m deep";
      }
      const std::optional<double> depth = *std::max_element(depths.begin(), depths.end());
      if (!depth || *depth <= kTouch) continue;
      ++contact_times_;
      ASSERT_FALSE(is_claimed) << "at " << time << " s, " << *depth << " m deep";
    }
    const std::vector<Regime>& regimes = came_["hand"].regimes;
    for (std::size_t i = 1; i < regimes.size(); ++i) {
      if (regimes[i - 1].is_static || regimes[i - 1].came.empty() || regimes[i].came.empty()) continue;
      const double last = Publication::lastOf(regimes[i - 1]), next = regimes[i].came.begin()->first;
      const double within = regimes[i].is_static ? last + 1e-4 : 0.5 * (last + next);
      ASSERT_FALSE(isLeftClear(within)) << "at the change at " << within << " s";
    }
  }

  int contactTimes() const { return contact_times_; }
  int clearTimes() const { return clear_times_; }
  int contradictions() const { return contradictions_; }
  int contactMessages() const { return contact_messages_; }
  int jumps() const { return jumps_; }

 private:
  struct Publisher {
    std::string frame, parent;
    double period, next, delay;
    double silent_until = 0.0;
  };
  struct Finding {
    std::size_t pair;
    Verdict verdict;
    ros::Time from, until;
  };
  struct Sent {
    double arrival, stamp;
    std::string frame, parent;
  };

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  std::size_t pick(std::size_t count) { return static_cast<std::size_t>(uniform(0.0, 0.999) * double(count)); }

  /// Pose of a frame in its parent.
  Sample poseOf(const std::string& frame, const std::string& parent, double time) const {
    const auto wave = [&](int i, double size) { return size * std::sin(rate_ * time + phases_[i]); };
    const auto about = [](double angle, const Vector3d& axis) { return Quaterniond(Eigen::AngleAxisd(angle, axis)); };
    if (frame == "base") return {time, about(wave(0, 0.3), Vector3d::UnitZ()), {wave(1, 0.2), 0.0, 0.0}};
    if (frame == "arm") return {time, about(wave(2, 1.2), Vector3d(0.0, 0.6, 0.8)), {0.2, wave(3, 0.05), 0.0}};
    if (frame == "foot") return {time, Quaterniond::Identity(), {0.3 + wave(4, 0.1), wave(5, 0.4), 0.0}};
    if (parent == "world") return {time, Quaterniond::Identity(), {wave(1, 0.5), 0.1, 0.0}};
    return {time, about(wave(3, 0.3), Vector3d::UnitX()), {wave(2, 0.03), 0.0, 0.0}};
  }

  void publish(Publisher& publisher, double now) {
    for (; publisher.next <= now; publisher.next += publisher.period) {
      const bool is_hand_static = publisher.frame == "hand" && hand_is_static_;
      if (publisher.next < publisher.silent_until || chance(drop_share_) || is_hand_static) continue;
      const double extra = chance(late_share_) ? uniform(0.0, 0.6) : 0.0;
      sent_.push_back({publisher.next + publisher.delay + extra, publisher.next, publisher.frame, publisher.parent});
    }
  }

  void deliver(double now) {
    std::stable_sort(sent_.begin(), sent_.end(), [](const Sent& a, const Sent& b) { return a.arrival < b.arrival; });
    while (!sent_.empty() && sent_.front().arrival <= now) {
      come(sent_.front());
      sent_.erase(sent_.begin());
    }
  }

  void come(const Sent& sent) {
    const Sample pose = poseOf(sent.frame, sent.parent, sent.stamp);
    const auto transform =
        stampedTransform(sent.parent, sent.frame, stampOf(sent.stamp), pose.rotation, pose.translation);
    loop_->history().add(message({transform}), false);
    std::vector<Regime>& regimes = came_[sent.frame].regimes;
    const bool is_new = regimes.empty() || regimes.back().is_static || regimes.back().parent != sent.parent;
    if (is_new) regimes.push_back({sent.parent, false, {}});
    regimes.back().came.try_emplace(sent.stamp, pose);
  }

  void sendStatic(double now) {
    hand_is_static_ = true;
    const Sample pose = poseOf("hand", "arm", now);
    loop_->history().add(message({stampedTransform("arm", "hand", stampOf(now), pose.rotation, pose.translation)}),
                         true);
    std::vector<Regime>& regimes = came_["hand"].regimes;
    regimes.push_back({"arm", true, {{now, pose}}});
  }

  /// Makes the hand static, or moving again, or changes its parent; all earlier transforms arrive first.
  void changeHand(double now) {
    for (const Sent& sent : sent_) {
      if (sent.frame == "hand") come(sent);
    }
    sent_.erase(std::remove_if(sent_.begin(), sent_.end(), [](const Sent& sent) { return sent.frame == "hand"; }),
                sent_.end());
    Publisher& hand = publishers_.back();
    if (hand_is_static_) {
      hand_is_static_ = false;
      hand.next = now;
    } else if (chance(0.5)) {
      sendStatic(now);
    } else {
      hand.parent = hand.parent == "arm" ? "world" : "arm";
      hand.next = now;
    }
  }

  /// Sets back the clock and all stamps; earlier messages are about another time.
  void jumpBack(double& now) {
    expectNoContactLeftClear();
    if (::testing::Test::HasFatalFailure()) return;
    const double back = uniform(0.3, 4.0);
    now -= back;
    for (Publisher& publisher : publishers_) {
      publisher.next -= back;
      publisher.silent_until -= back;
    }
    EXPECT_EQ(loop_->step(stampOf(now), {}), Step::kJump);
    sent_.clear();
    said_.clear();
    found_.clear();
    for (auto& [frame, publication] : came_) {
      std::vector<Regime>& regimes = publication.regimes;
      const bool is_static = !regimes.empty() && regimes.back().is_static;
      regimes.erase(regimes.begin(), is_static ? std::prev(regimes.end()) : regimes.end());
    }
    ++jumps_;
  }

  void step(double now) {
    clock_runs_ = true;
    if (loop_->step(stampOf(now), {}) != Step::kCycle) return;
    said_.push_back(toContactArray(*loop_));
    const TrackedCycle& cycle = loop_->cycle();
    for (std::size_t pair = 0; pair < loop_->result().pairs.size(); ++pair) {
      const PairResult& result = loop_->result().pairs[pair];
      if (result.span.empty()) continue;
      found_.push_back({pair, result.verdict, cycle.origin + ros::Duration(cycle.motion.times[result.span.first]),
                        cycle.origin + ros::Duration(cycle.motion.times[result.span.last])});
    }
    contradictions_ += !said_.back().cycle.contradicted_since.isZero();
    contact_messages_ += said_.back().verdict == numberOf(Verdict::kContact);
  }

  static ros::Time stampOf(double time) { return ros::Time(100.0 + time); }

  std::optional<Isometry3d> truePose(std::string frame, double time) const {
    Isometry3d X_WF = Isometry3d::Identity();
    while (frame != "world") {
      const auto publication = came_.find(frame);
      if (publication == came_.end()) return std::nullopt;
      const std::optional<Isometry3d> X_PF = publication->second.poseAt(time, frame);
      if (!X_PF) return std::nullopt;
      X_WF = *X_PF * X_WF;
    }
    return X_WF;
  }

  /// The true depth of each pair, if its poses are known.
  std::vector<std::optional<double>> trueDepths(double time) const {
    const std::optional<Isometry3d> hand = truePose("hand", time), foot = truePose("foot", time);
    const auto inPlate = [&](const Vector3d& p) {
      const Vector3d beyond = ((p - Vector3d(kPlate, 0.0, 0.0)).cwiseAbs() - Vector3d(kPlateHalf, 0.5, 0.5));
      return kRadius - beyond.cwiseMax(0.0).norm();
    };
    std::vector<std::optional<double>> depths;
    for (const PlannedPair& pair : loop_->scene().pairs) {
      const auto moves = [&](const char* name) {
        return loop_->scene().bodies[pair.body_a].name == name || loop_->scene().bodies[pair.body_b].name == name;
      };
      depths.emplace_back();
      if ((moves("hand") && !hand) || (moves("foot") && !foot)) continue;
      const Vector3d p_hand = moves("hand") ? Vector3d(*hand * Vector3d(0.2, 0.0, 0.0)) : Vector3d(0.0, 0.0, 0.0);
      const Vector3d p_foot = moves("foot") ? Vector3d(foot->translation()) : Vector3d(0.0, 0.0, 0.0);
      depths.back() =
          moves("plate") ? inPlate(moves("hand") ? p_hand : p_foot) : 2.0 * kRadius - (p_hand - p_foot).norm();
    }
    return depths;
  }

  /// Whether a subscriber that discards contradicted results ends up with CLEAR for a time.
  bool isLeftClear(double seconds) const {
    const ros::Time time = stampOf(seconds);
    bool is_clear = false;
    for (const ContactArray& said : said_) {
      const CycleStatus& cycle = said.cycle;
      if (!cycle.contradicted_since.isZero() && cycle.contradicted_since <= time) is_clear = false;
      is_clear |= said.verdict == numberOf(Verdict::kClear) && cycle.start <= time && time <= cycle.complete_until;
    }
    return is_clear;
  }

  /// Whether the last result for a pair at a time is CLEAR.
  bool isLeftClear(std::size_t pair, double seconds) const {
    const ros::Time time = stampOf(seconds);
    bool is_clear = false;
    for (const Finding& found : found_) {
      if (found.pair == pair && found.from <= time && time <= found.until) is_clear = found.verdict == Verdict::kClear;
    }
    return is_clear;
  }

  std::mt19937 random_;
  std::unique_ptr<MonitorLoop> loop_;
  double phases_[6];
  double rate_, delay_, late_share_, drop_share_;
  std::vector<Publisher> publishers_;  // the hand's is the last
  bool hand_is_static_ = false;
  bool clock_runs_ = false;
  std::vector<Sent> sent_;  // sent, but not yet arrived
  std::map<std::string, Publication> came_;
  std::vector<ContactArray> said_;
  std::vector<Finding> found_;
  int contact_times_ = 0, clear_times_ = 0, contradictions_ = 0, contact_messages_ = 0, jumps_ = 0;
};

TEST(TfDisturbed, NoTimeOfContactIsLeftAsClear) {
  int contacts = 0, clears = 0, contradictions = 0, contact_messages = 0, jumps = 0;
  for (unsigned seed = 1; seed <= kEpisodes; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Episode episode(seed);
    episode.play();
    episode.expectNoContactLeftClear();
    if (HasFatalFailure()) return;
    contacts += episode.contactTimes();
    clears += episode.clearTimes();
    contradictions += episode.contradictions();
    contact_messages += episode.contactMessages();
    jumps += episode.jumps();
  }
  // The episodes contain enough of each case.
  EXPECT_GT(contacts, 3000);
  EXPECT_GT(clears, 3000);
  EXPECT_GT(contradictions, 100);
  EXPECT_GT(contact_messages, 300);
  EXPECT_GT(jumps, 5);
  RecordProperty("times_of_contact", contacts);
  RecordProperty("times_left_clear", clears);
}

}  // namespace sdf_ccd::tf_disturbed_test
