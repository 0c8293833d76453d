#include "motion/validate_motion.h"

#include <cmath>
#include <stdexcept>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

/// Throws with a text that is only made in case of an error.
struct Refusal {
  const char* what;

  [[noreturn]] void operator()(const std::string& why) const {
    throw std::invalid_argument(std::string(what) + ": " + why);
  }
};

void requireTimes(const std::vector<double>& times, const Refusal& refuse) {
  if (times.size() < 2) refuse(std::to_string(times.size()) + " times, two or more are needed");
  if (times.front() != 0.0) refuse("starts at " + numberText(times.front()) + " s, not 0");
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k - 1] < times[k]) || !std::isfinite(times[k]))
      refuse("times must be finite and increasing: " + numberText(times[k - 1]) + " s is followed by " +
             numberText(times[k]) + " s");
}

void requireSpans(const CycleMotion& motion, std::size_t pairs, const Refusal& refuse) {
  if (!motion.spans.empty() && motion.spans.size() != pairs)
    refuse(std::to_string(motion.spans.size()) + " spans, the scene has " + std::to_string(pairs) + " pairs");
  for (const WaypointSpan& span : motion.spans)
    if (span.first > span.last || span.last >= motion.times.size())
      refuse("span [" + std::to_string(span.first) + ", " + std::to_string(span.last) + "] is not within the " +
             std::to_string(motion.times.size()) + " times");
}

}  // namespace

void validate(const CycleMotion& motion, const MotionShape& shape, const char* what) {
  const Refusal refuse{what};
  requireTimes(motion.times, refuse);
  requireSpans(motion, shape.pairs, refuse);
  const std::size_t bodies = shape.bodies.size();
  const auto requireFit = [&](std::size_t size, const char* made_for) {
    if (size != bodies) refuse(made_for + std::to_string(size) + " bodies, the scene has " + std::to_string(bodies));
  };
  requireFit(motion.X_WB.size(), "made for ");
  if (!motion.missing.empty()) requireFit(motion.missing.size(), "lists missing poses for ");
  if (!motion.motion_error.empty()) requireFit(motion.motion_error.size(), "has motion errors of ");
  const auto may_lack = [&](std::size_t b) {
    return (!shape.without_poses.empty() && shape.without_poses[b]) ||
           (!motion.missing.empty() && !motion.missing[b].empty());
  };
  for (std::size_t b = 0; b < bodies; ++b) {
    const std::size_t poses = motion.X_WB[b].size();
    if (poses != motion.times.size() && poses != 1 && !may_lack(b))
      refuse(shape.bodies[b] + " has " + std::to_string(poses) + " poses at " + std::to_string(motion.times.size()) +
             " times");
  }
  for (std::size_t b = 0; b < motion.motion_error.size(); ++b)
    if (!(motion.motion_error[b] >= 0.0))
      refuse("motion error of " + shape.bodies[b] + " is " + numberText(motion.motion_error[b]));
}

}  // namespace sdf_ccd
