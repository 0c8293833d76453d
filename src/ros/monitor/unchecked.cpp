#include "ros/monitor/unchecked.h"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "common/counted.h"
#include "ros/tf/seconds_between.h"
#include "scene/name_pair.h"

namespace sdf_ccd {
namespace {

/// Delayed pairs are not counted: their result is still open.
bool isUnchecked(const PairResult& pair) {
  return pair.verdict == Verdict::kNotChecked && !pair.span.empty();
}

std::string pairReason(const MonitorLoop& loop, const PairResult& pair) {
  return pairName(loop.scene(), pair) + ": " + pair.reason;
}

std::vector<std::string> missingBodies(const MonitorLoop& loop) {
  std::vector<std::string> lines;
  setMissingBodies(loop, lines);
  return lines;
}

}  // namespace

const std::string& uncheckedReason(const MonitorLoop& loop, int body) {
  const std::string& failure = loop.scene().bodies[body].failure;
  return failure.empty() ? loop.cycle().motion.missing[body] : failure;
}

bool isOfUncheckedBody(const MonitorLoop& loop, const PairResult& pair) {
  return !uncheckedReason(loop, pair.body_a).empty() || !uncheckedReason(loop, pair.body_b).empty();
}

void setUncheckedCycle(const MonitorLoop& loop, std::string& reason) {
  const CycleResult& result = loop.result();
  const TrackedCycle& cycle = loop.cycle();
  reason.clear();
  if (result.verdict != Verdict::kNotChecked) return;
  const auto text = std::back_inserter(reason);
  if (result.pairs.empty()) reason = "no pairs: there is nothing to check";
  const auto first = std::find_if(result.pairs.begin(), result.pairs.end(), isUnchecked);
  if (first != result.pairs.end()) {
    const BodyList& bodies = loop.scene().bodies;
    fmt::format_to(text, "{} could not be checked, for example {} - {}: {}",
                   counted(static_cast<std::size_t>(result.not_checked), "pair"), bodies[first->body_a].name,
                   bodies[first->body_b].name, first->reason);
  }
  if (result.delayed > 0) {
    fmt::format_to(text, "{}{} pairs wait for transforms, for up to {:.3f} s", reason.empty() ? "" : ", ",
                   result.delayed, secondsBetween(cycle.delayed_since, cycle.end));
  }
}

void setUncheckedBodies(const MonitorLoop& loop, std::vector<UncheckedBody>& bodies) {
  const TrackedCycle& cycle = loop.cycle();
  std::size_t count = 0;
  for (std::size_t b = 0; b < loop.scene().bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    const std::string& reason = uncheckedReason(loop, body);
    if (reason.empty()) continue;
    if (count == bodies.size()) bodies.emplace_back();
    UncheckedBody& entry = bodies[count++];
    entry.body = loop.scene().bodies[b].name;
    entry.reason = reason;
    entry.since = std::min(cycle.start, loop.uncheckedSince()[b]);
    entry.pairs = loop.pairsOfBodies()[b];
  }
  bodies.resize(count);
}

void setMissingBodies(const MonitorLoop& loop, std::vector<std::string>& lines) {
  const std::vector<std::string>& missing = loop.cycle().motion.missing;
  std::size_t count = 0;
  for (std::size_t body = 0; body < missing.size(); ++body) {
    if (missing[body].empty()) continue;
    if (count == lines.size()) lines.emplace_back();
    std::string& line = lines[count++];
    line = loop.scene().bodies[body].name;
    line += ": ";
    line += missing[body];
  }
  lines.resize(count);
}

std::string uncheckedCause(const MonitorLoop& loop) {
  const std::vector<std::string> missing = missingBodies(loop);
  if (missing.empty()) return {};
  const auto causeOf = [](const std::string& line) { return line.substr(line.rfind(": ") + 1); };
  std::map<std::string, std::size_t> bodies;  // by cause
  for (const std::string& line : missing) ++bodies[causeOf(line)];
  const auto shares = [&](const std::string& a, const std::string& b) {
    return bodies[causeOf(a)] < bodies[causeOf(b)];
  };
  const std::size_t others = missing.size() - 1;
  return *std::max_element(missing.begin(), missing.end(), shares) +
         (others == 0   ? ""
          : others == 1 ? "; and 1 more body"
                        : "; and " + std::to_string(others) + " more bodies");
}

std::string uncheckedPair(const MonitorLoop& loop) {
  const CycleResult& result = loop.result();
  if (static_cast<std::size_t>(result.not_checked) == result.failed.size()) return {};
  for (const PairResult& pair : loop.result().pairs) {
    if (isUnchecked(pair) && !isOfUncheckedBody(loop, pair)) return pairReason(loop, pair);
  }
  return {};
}

std::vector<std::string> failedBodies(const Scene& scene) {
  std::vector<std::string> lines;
  for (const Body& body : scene.bodies) {
    if (!body.failure.empty()) lines.push_back(body.name + ": " + body.failure);
  }
  return lines;
}

}  // namespace sdf_ccd
