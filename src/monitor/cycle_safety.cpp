#include "monitor/cycle_safety.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "common/infinity.h"
#include "common/number_text.h"
#include "monitor/pair_traits.h"

namespace sdf_ccd {
namespace {

CycleFinding findingOf(const CycleFacts& facts, const SafetyRules& rules) {
  const CycleResult& result = facts.result;
  if (result.pairs.empty()) return CycleFinding::kNoPair;
  if (result.verdict == Verdict::kContact) return CycleFinding::kContact;
  if (result.verdict == Verdict::kUncertain) return CycleFinding::kUncertain;
  const bool is_only_delayed = result.verdict == Verdict::kNotChecked && result.delayed > 0;
  if (result.not_checked > 0 || !(result.verdict == Verdict::kClear || is_only_delayed))
    return CycleFinding::kNotChecked;
  if (facts.has_unknown) return CycleFinding::kUnmeasured;
  if (rules.promise && !(facts.oldest <= rules.promise->max_age)) return CycleFinding::kOld;
  return is_only_delayed ? CycleFinding::kDelayed : CycleFinding::kClear;
}

bool mayMove(CycleFinding finding) {
  return finding == CycleFinding::kDelayed || finding == CycleFinding::kClear;
}

/// Contact is what the monitor is for; what it does not know is a fault.
Health healthOf(const CycleResult& result, CycleFinding finding) {
  if (finding == CycleFinding::kNoPair || finding == CycleFinding::kNotChecked || result.not_checked > 0)
    return Health::kError;
  const bool is_late = finding == CycleFinding::kUnmeasured || finding == CycleFinding::kOld || result.delayed > 0;
  return is_late ? Health::kWarn : Health::kOk;
}

Proximity proximityOf(bool may_move, const std::vector<PairDistance>& near, const SafetyRules& rules,
                      ProximityWatch& watch) {
  if (!rules.watchesProximity()) return Proximity::kNotWatched;
  const ProximityThresholds& thresholds = rules.thresholds;
  if (!may_move) return watch.update(-kInfinity, -kInfinity, thresholds.hysteresis), Proximity::kStop;
  double to_warning = kInfinity, to_stop = kInfinity;
  for (const PairDistance& pair : near) {
    const PairTraits& traits = traitsOf(pair, rules.traits);
    if (cannotChange(pair, traits)) continue;
    const double stop = traits.stop_distance.value_or(thresholds.stop);
    if (thresholds.warning > 0.0) to_warning = std::min(to_warning, pair.any.width - thresholds.warning);
    if (stop > 0.0) to_stop = std::min(to_stop, pair.any.width - stop);
  }
  return watch.update(to_warning, to_stop, thresholds.hysteresis);
}

/// Why the scale is 0 for another reason than a distance; empty if it is not.
const char* whyStopped(CycleFinding finding) {
  switch (finding) {
    case CycleFinding::kNoPair:
      return "nothing is checked";
    case CycleFinding::kContact:
      return "a pair is in CONTACT";
    case CycleFinding::kUncertain:
      return "a pair is UNCERTAIN";
    case CycleFinding::kNotChecked:
      return "a pair is NOT_CHECKED";
    case CycleFinding::kUnmeasured:
      return "a pair waits for transforms, and its distance is not known";
    case CycleFinding::kOld:
      return "data are older than velocity_scale/max_age";
    case CycleFinding::kDelayed:
    case CycleFinding::kClear:
      break;
  }
  return "";
}

}  // namespace

double safetyRange(const SafetyRules& rules) {
  const double stop = largestStopDistance(rules.traits, rules.thresholds.stop);
  double range = 0.0;
  if (rules.watchesProximity()) range = std::max(rules.thresholds.warning, stop) + rules.thresholds.hysteresis;
  if (rules.promise) range = std::max(range, scaleRange(*rules.promise, stop));
  return range;
}

CycleSafety judgeCycle(const CycleFacts& facts, const SafetyRules& rules, SafetyMemory& memory) {
  CycleSafety safety;
  safety.finding = findingOf(facts, rules);
  safety.health = healthOf(facts.result, safety.finding);
  const bool may_move = mayMove(safety.finding);
  safety.proximity = proximityOf(may_move, facts.near, rules, memory.proximity);
  if (!rules.promise) return safety;
  safety.velocity_scale = 0.0;
  if (may_move) {
    const StoppingPromise& promise = *rules.promise;
    PublishedScales& scales = memory.scales;
    const ScaleLimits limits =
        velocityScales(facts.near, rules.traits, facts.age, facts.oldest, scales.obeyed(facts.time, promise), promise);
    const ScaleLimit measured = scales.limitRise(limits.measured, facts.time, promise);
    const ScaleLimit& limit = measured.scale < limits.promised.scale ? measured : limits.promised;
    safety.velocity_scale = limit.scale;
    safety.limiting = limit.pair;
    scales.add(limit.scale, facts.time, promise);
  }
  return safety;
}

CycleSafety judgeNoCycle(const SafetyRules& rules, SafetyMemory& memory) {
  const CycleResult none;
  const std::vector<PairDistance> near;
  return judgeCycle({none, near}, rules, memory);
}

std::string promiseText(const StoppingPromise& promise) {
  const std::string world = "if nothing but the robot moves, nothing of the world comes closer than its stop distance";
  return promise.own_pairs == OwnPairs::kPromise
             ? world + ", and no two of its links do, if each joint keeps to the scale times its limit of speed"
             : world +
                   "; of its own links nothing is promised (a table in the URDF is one): they limit by their "
                   "measured closing motion alone";
}

std::string rangeText(const SafetyRules& rules) {
  if (!rules.promise) return {};
  const StoppingPromise& promise = *rules.promise;
  const double stop = std::max(promise.stop_distance, 0.0), V = promise.max_speed;
  const auto standstill = [&](double speed) { return lengthText(standstillDistance(promise, stop, speed)); };
  std::string text = "velocity_scale: a robot at rest gets 0 where something of the world is closer than " +
                     standstill(V) + ", and 1 where everything is farther than " +
                     lengthText(scaleRange(promise, stop));
  if (promise.own_pairs == OwnPairs::kMeasured)
    return text + "; pairs of its own links limit while they close" +
           (stop > 0.0 ? ", and give 0 closer than " + lengthText(stop) : "");
  double slowest = V, fastest = 0.0;
  for (const PairTraits& pair : rules.traits) {
    if (!pair.is_own || pair.is_constant) continue;
    slowest = std::min(slowest, pair.max_closing);
    fastest = std::max(fastest, std::min(pair.max_closing, V));
  }
  if (fastest == 0.0) return text;
  return text + "; the same for pairs of its own links, by the speeds of their joints: 0 closer than " +
         standstill(slowest) + " to " + standstill(fastest);
}

bool isTooClose(const PairDistance& pair, const SafetyRules& rules) {
  const PairTraits& traits = traitsOf(pair, rules.traits);
  return pair.any.width <= traits.stop_distance.value_or(rules.thresholds.stop) && !cannotChange(pair, traits);
}

void setLimit(const CycleSafety& safety, const Scene& scene, const SafetyRules& rules, std::string& text) {
  text.clear();
  if (!safety.velocity_scale || *safety.velocity_scale >= 1.0) return;
  text = whyStopped(safety.finding);
  if (!text.empty()) return;
  if (!safety.limiting) {
    text = "it rises slowly from what a pair of the last scene allowed";
    return;
  }
  const PairDistance& pair = *safety.limiting;
  const PairTraits& traits = traitsOf(pair, rules.traits);
  const double stop = traits.stop_distance.value_or(rules.thresholds.stop);
  const bool is_measured = traits.is_own && rules.promise && rules.promise->own_pairs == OwnPairs::kMeasured;
  const auto add = [&](const char* format, const auto&... values) {
    fmt::format_to(std::back_inserter(text), format, values...);
  };
  add("{} - {}: {} apart", scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name, lengthText(pair.any.width));
  if (pair.any.width <= stop) return add(", within its stop distance of {}", lengthText(stop));
  if (is_measured) return add(", closed at {:.3g} m/s", pair.closing_speed);
  if (pair.closing_speed > 0.0) add(", closes at {:.3g} m/s", pair.closing_speed);
  text += traits.is_own ? ", two links, which velocity_scale/own_pairs: promise limits by what they can do"
                        : ", which is less than a robot may need to stop";
}

}  // namespace sdf_ccd
