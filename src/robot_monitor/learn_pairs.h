#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "robot/joint_states.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

struct LearnOptions {
  std::size_t states = 10'000;  ///< drawn by JointSampler
  std::uint64_t seed = 1;       ///< of the sampler
  JointStates recorded;         ///< further states; joints that are not named are as in the default state
  double max_error = 0.005;     ///< of the verdict about a pair in a state [m]; see BodyOptions::max_error
  bool default_pairs = false;   ///< also leave out pairs that touch or may touch in the default state, but not always
  std::function<void(const std::string& what, double share)> progress;  ///< may throw to cancel
};

/// The result for all pairs of a robot's links that have collision shapes, in the order of its links.
struct LearnedPairs {
  std::vector<PairDecision> disabled;    ///< need no check: kAdjacent, kAlways, kNever, kAtRest
  std::vector<PairDecision> touching;    ///< touch in some states: to be checked
  std::vector<PairDecision> close;       ///< come within the error bound of each other: to be checked
  std::vector<PairDecision> unknown;     ///< no result, and why: to be checked
  std::vector<PairDecision> at_default;  ///< of these, and Default: CONTACT or UNCERTAIN in the default state
  std::size_t known = 0;                 ///< number of pairs decided by the given SRDF
  std::size_t states = 0, recorded = 0;  ///< tested states, besides the default state
  std::size_t always_states = 0;         ///< lower bound of the random states in which Always was tested
  std::uint64_t seed = 0;                ///< of the random states
  double error_bound = 0.0;              ///< largest of the pairs [m]
  double build_seconds = 0.0, test_seconds = 0.0;
  std::vector<std::string> warnings;
};

/// Learns which pairs of a robot's links need no check, from states.
///
///  - Adjacent: they are joined by one joint, or by one that moves and else fixed ones to links without collision
///    shapes. They are not tested.
///  - Always: they touch in every state, deeper than the error bound; or as neighbours they do so or come within 1 mm,
///    and in none of them enter each other by more while they are apart in others (ObservedPair). About a thousand
///    random states are tested, as each needs a search for all contact points: a pair that separates in less than 0.3 %
///    of states may be classified as Always.
///  - Never: they are farther apart than the error bound in every state. That is no proof: after n states without a
///    touch, a pair touches with 95 % confidence in less than 3 / n of the states that could have been drawn.
///  - Default, if requested: they are CONTACT or UNCERTAIN in the default state, with joints at zero or at the nearest
///    limit. They may separate and touch again in other states; such contacts are then not found.
///
/// Pairs that the given SRDF disables or enables stay as it says and are not tested. Nothing is learned of pairs with a
/// planar, floating or unlimited prismatic joint between them, or whose shapes cannot be read. The result depends on
/// the states and the meshes only, not on the number of threads (those of the caller's TBB arena).
/// @throws std::invalid_argument if there are no states, or max_error cannot be met; std::length_error if that needs
/// far more memory than one field or shell may take (see buildScene()).
LearnedPairs learnPairs(const RobotModel& robot, const Srdf& srdf, const ResourceLoader& loader,
                        const LearnOptions& options);

/// An SRDF with the content of the given one, followed by the pairs.
/// @param given  text of an SRDF; if empty, the result has only the pairs.
/// @throws std::runtime_error if it is no SRDF.
std::string srdfWith(const LearnedPairs& pairs, const RobotModel& robot, const std::string& given);

}  // namespace sdf_ccd
