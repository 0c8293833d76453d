#include "adversarial/ros/ros_family.h"

#include <algorithm>
#include <array>
#include <memory>

#include "adversarial/duel.h"
#include "adversarial/ros/tf_stream.h"
#include "adversarial/ros/tf_truth.h"
#include "oracle/shapes.h"
#include "ros/described_world.h"
#include "ros/monitor/monitor_loop.h"

namespace sdf_ccd::test {
namespace {

constexpr Real kUnseen = 1e-7L;  ///< resolution, as stamps are whole nanoseconds [m]
constexpr Real kUnknown = 1e3L;  ///< larger separations mean that nothing is known [m]

const char* toText(Trouble trouble) {
  const char* texts[] = {
      "steady", "late", "silent", "out of order", "two clocks", "loop", "static, then moving", "moving, then static"};
  return texts[int(trouble)];
}

/// An arm, a hand and a plate that rests.
class World {
 public:
  World() {
    const Vector3d arm(0.4, 0.02, 0.02), hand(0.15, 0.03, 0.03);
    actors_ = {boxActor(arm, {0.4, 0, 0}), convexActor("hand", boxMesh(hand), {0.15, 0, 0}),
               boxActor({0.3, 0.3, 0.01}, {0, 0, -0.5})};
    const char* names[] = {"arm", "hand", "plate"};
    SceneDescription description;
    for (int b = 0; b < 3; ++b) {
      BodyDescription body;
      body.name = names[b];
      body.frame = b < 2 ? names[b] : "world";
      body.is_world = b == 2;
      body.geometry = actors_[std::size_t(b)].geometry;
      description.bodies.push_back(body);
      carried.push_back({names[b], &actors_[std::size_t(b)].solid});
    }
    BodyOptions options;
    options.field.max_error = 2e-3;
    options.shell.spacing = 0.04;
    options.shell.edge_gap = 4e-3;
    scene =
        std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(options)), options));
  }

  std::shared_ptr<const Scene> scene;
  std::vector<TfTruth::Carried> carried;

 private:
  std::vector<Actor> actors_;
};

TfEvent plateEvent() {
  TfEvent event;
  event.transform.header.frame_id = "world";
  event.transform.child_frame_id = "plate";
  event.transform.transform.rotation.w = 1.0;
  event.is_static = true;
  return event;
}

void shiftBase(const Vector3d& by, std::vector<TfEvent>& events) {
  for (TfEvent& event : events) {
    if (event.transform.child_frame_id != "base") continue;
    event.transform.transform.translation.x += by.x();
    event.transform.transform.translation.y += by.y();
    event.transform.transform.translation.z += by.z();
  }
}

/// Moves the hand's base so that the minimum separation of the hand from another body is `wanted` [m].
void aim(const World& world, std::size_t other, double wanted, std::vector<TfEvent>& events) {
  for (int i = 0; i < 3; ++i) {
    TfTruth truth;
    truth.add(plateEvent().transform, true);
    for (const TfEvent& event : events) {
      if (event.jumps_back && &event != &events.front()) break;
      truth.add(event.transform, event.is_static);
    }
    const ros::Time from(TfTruth::kEpoch), to(TfTruth::kEpoch + 10.0);
    const LeastValue least = truth.least(world.carried[other], world.carried[1], from, to, {2e-3L});
    if (least.high > kUnknown) return;
    const Vector3d axis = truth.at(world.carried[other], world.carried[1], least.at).axis_W.cast<double>();
    shiftBase((wanted - double(least.high)) * axis, events);
  }
}

/// Plays a stream and judges every cycle by the transforms that have arrived.
class Play {
 public:
  Play(const World& world, const MonitorParameters& parameters, Trouble trouble, Tally& tally)
      : world_(world), loop_(world.scene, describedWorld(), parameters), trouble_(trouble), tally_(tally) {
    take(plateEvent());
  }

  void take(const TfEvent& event) {
    if (event.jumps_back) {
      truths_[0].forgetMoving();
      // With two clocks it is unknown which one is right, so one of the truths keeps the transforms.
      if (trouble_ == Trouble::kLoop) truths_[1].forgetMoving();
    }
    tf2_msgs::TFMessage message;
    message.transforms = {event.transform};
    for (TfTruth& truth : truths_) truth.add(event.transform, event.is_static);
    loop_.history().add(message, event.is_static);
  }

  void step(double now) {
    if (loop_.step(ros::Time(now), {false, 0}) != TfTracker::Step::kCycle) return;
    const TrackedCycle& cycle = loop_.cycle();
    const CycleResult& result = loop_.result();
    ++tally_.cases;
    switch (result.verdict) {
      case Verdict::kClear:
        ++tally_.clear;
        break;
      case Verdict::kContact:
        ++tally_.contact;
        break;
      case Verdict::kUncertain:
        ++tally_.uncertain;
        break;
      case Verdict::kNotChecked:
        ++tally_.not_checked;
    }
    for (const PairResult& pair : result.pairs) {
      const auto time = [&](std::size_t waypoint) {
        return cycle.origin + ros::Duration(cycle.motion.times[waypoint]);
      };
      if (!pair.span.empty()) judge(pair, time(pair.span.first), time(pair.span.last));
      if (!pair.span.empty() && tally_.cases % 8 == 0) place(pair, time(pair.span.first), time(pair.span.last));
      if (result.verdict != Verdict::kClear) continue;
      judgeClear(pair, cycle.start, cycle.complete_until, " as a whole");
      if (pair.span.empty()) unseen_.push_back({pair, cycle.start, cycle.end});
    }
  }

  /// Judges pairs that were delayed in a cycle that was CLEAR as a whole, by all transforms. Only for streams whose
  /// transforms arrive late but in order.
  void finish() {
    if (trouble_ != Trouble::kLate && trouble_ != Trouble::kSilent && trouble_ != Trouble::kNone) return;
    for (const Unseen& unseen : unseen_) judgeClear(unseen.pair, unseen.start, unseen.end, " with a delayed pair");
  }

 private:
  struct Unseen {
    PairResult pair;
    ros::Time start, end;
  };

  /// Minimum separation according to each truth.
  std::array<LeastValue, 2> least(const PairResult& pair, const ros::Time& from, const ros::Time& to,
                                  const LeastOptions& options) const {
    const auto ask = [&](const TfTruth& truth) {
      return truth.least(body(pair.body_a), body(pair.body_b), from, to, options);
    };
    const LeastValue first = ask(truths_[0]);
    return {first, trouble_ == Trouble::kTwoClocks ? ask(truths_[1]) : first};
  }

  void judge(const PairResult& pair, const ros::Time& from, const ros::Time& to) {
    if (pair.verdict == Verdict::kClear) judgeClear(pair, from, to, "");
    if (pair.verdict != Verdict::kContact) return;
    const auto found = least(pair, from, to, {0, kUnseen, 0});
    const Real low = std::min(found[0].low, found[1].low);
    if (low <= kUnseen || low > kUnknown) return;
    ++tally_.false_contact;
    tally_.fail(std::string(toText(trouble_)) + ": CONTACT", std::to_string(double(low)) + " m apart");
  }

  void judgeClear(const PairResult& pair, const ros::Time& from, const ros::Time& to, const char* how) {
    if (!(from < to)) return;
    const auto found = least(pair, from, to, {0, 0, -kUnseen});
    const Real high = std::max(found[0].high, found[1].high);
    if (high >= -kUnseen) return;
    ++tally_.false_clear;
    tally_.deepest = std::max(tally_.deepest, double(-high));
    tally_.fail(std::string(toText(trouble_)) + ": CLEAR" + how, std::to_string(double(-high)) + " m deep");
  }

  void place(const PairResult& pair, const ros::Time& from, const ros::Time& to) {
    const Real near = 3.0L * world_.scene->bound.total();
    ++tally_.placed;
    tally_.near += std::abs(least(pair, from, to, {near / 30, near, -near})[0].high) < near;
  }

  const TfTruth::Carried& body(int index) const { return world_.carried[std::size_t(index)]; }

  const World& world_;
  MonitorLoop loop_;
  std::array<TfTruth, 2> truths_;  ///< after a jump back in time, the second keeps its transforms, except in a loop
  Trouble trouble_;
  Tally& tally_;
  std::vector<Unseen> unseen_;
};

}  // namespace

Tally rosStreams(std::uint64_t seed, long cases) {
  Random random(seed);
  const World world;
  MonitorParameters parameters;
  parameters.monitor.chords.tolerance = 2e-4;
  parameters.tf.sampling.tolerance = 2e-4;
  const double bound = world.scene->bound.total();
  Tally tally;
  while (tally.cases < cases) {
    const Trouble trouble = Trouble(random() % kTroubles);
    std::vector<TfEvent> events = randomStream(random, trouble);
    aim(world, random() % 3 == 0 ? 2 : 0, uniform(random, -3.0, 3.0) * bound, events);
    Play play(world, parameters, trouble, tally);
    const std::size_t batch = 1 + random() % 8;  // transforms that arrive between two steps
    for (std::size_t i = 0; i < events.size(); ++i) {
      play.take(events[i]);
      if (i % batch == 0) play.step(events[i].arrival);
    }
    play.finish();
  }
  return tally;
}

}  // namespace sdf_ccd::test
