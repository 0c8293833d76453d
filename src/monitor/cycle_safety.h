#pragma once

#include <optional>
#include <string>
#include <vector>

#include "monitor/pair_traits.h"
#include "monitor/proximity.h"
#include "sdf_ccd/distances.h"

namespace sdf_ccd {

/// What a cycle found that bears on whether a robot may move: the first of these that holds.
enum class CycleFinding {
  kNoPair,      ///< there is nothing to check, or no cycle
  kContact,     ///< a pair is in CONTACT
  kUncertain,   ///< a pair is UNCERTAIN
  kNotChecked,  ///< a pair is NOT_CHECKED
  kUnmeasured,  ///< a pair is delayed, and its distance was never known
  kOld,         ///< a pair is delayed, or all are late, by more than StoppingPromise::max_age
  kDelayed,     ///< a pair is delayed by less
  kClear,       ///< every pair is CLEAR
};

/// A cycle, as judgeCycle() sees it.
struct CycleFacts {
  const CycleResult& result;
  const std::vector<PairDistance>& near;  ///< the measured pairs, within safetyRange(); empty if that is 0
  bool has_unknown = false;               ///< PairDistances::hasUnknown()
  double age = 0.0;     ///< of the cycle's time 0 [s]: that of a pair's distance is this minus PairDistance::time
  double oldest = 0.0;  ///< age of the oldest data of any pair [s]
  double time = 0.0;    ///< when the cycle is judged, on any clock [s]
};

/// What is remembered from cycle to cycle.
struct SafetyMemory {
  ProximityWatch proximity;
  PublishedScales scales;
};

/// What the robot is promised, and where warnings begin.
struct SafetyRules {
  ProximityThresholds thresholds;          ///< the stop distance of pairs without one of their own
  std::optional<StoppingPromise> promise;  ///< none: there is no velocity scale
  const std::vector<PairTraits>& traits;   ///< per pair of the scene

  /// Whether there is a level of proximity.
  bool watchesProximity() const { return thresholds.any() || largestStopDistance(traits, thresholds.stop) > 0.0; }
};

/// How a program that supervises the monitor should see a cycle.
enum class Health { kOk, kWarn, kError };

/// What is derived from a cycle. As it is default-made nothing is known, and the robot must stop.
struct CycleSafety {
  CycleFinding finding = CycleFinding::kNoPair;
  std::optional<double> velocity_scale;  ///< in [0, 1]; none: there is none
  std::optional<PairDistance> limiting;  ///< the pair that limits the scale, where a distance does
  Proximity proximity = Proximity::kNotWatched;
  Health health = Health::kError;
};

/// The distance up to which judgeCycle() must know all pairs [m]; 0: no distance is needed.
double safetyRange(const SafetyRules& rules);

/// Derives velocity scale, proximity and health from a cycle: nothing else decides about them. Unless every pair is
/// CLEAR, or only delayed, the scale is 0 and proximity kStop. Of a delayed pair the last distance counts, with its
/// age. Pairs whose distance cannot change count in neither.
CycleSafety judgeCycle(const CycleFacts& facts, const SafetyRules& rules, SafetyMemory& memory);

/// The same while no cycle runs.
CycleSafety judgeNoCycle(const SafetyRules& rules, SafetyMemory& memory);

/// What the scale promises, in one line.
std::string promiseText(const StoppingPromise& promise);

/// Below which distances a robot at rest is given 0, and from which on 1, in one line.
std::string rangeText(const SafetyRules& rules);

/// Whether a pair has come within its stop distance, and can leave it.
bool isTooClose(const PairDistance& pair, const SafetyRules& rules);

/// Sets why the scale is less than 1; empty if it is not, or there is none: "link5 - link7: 22 mm apart, closes at 0.1
/// m/s; …". Reuses the text's memory.
void setLimit(const CycleSafety& safety, const Scene& scene, const SafetyRules& rules, std::string& text);

}  // namespace sdf_ccd
