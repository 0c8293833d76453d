#include "cycle_statistics.h"

#include <algorithm>
#include <array>
#include <regex>
#include <tuple>

#include "common/counted.h"
#include "common/number_text.h"
#include "precision/error_summary.h"
#include "ros/messages/conversions.h"
#include "scene/name_pair.h"

namespace sdf_ccd::tools {
namespace {

constexpr std::size_t kNamed = 10;  // printed items of a list

/// The quantiles times 1000 (seconds as ms, metres as mm), separated by slashes.
std::string quantiles(std::vector<double> values, const std::vector<double>& shares) {
  std::string text;
  for (const double share : shares)
    text += (text.empty() ? "" : " / ") + shortText(1e3 * precision::quantile(values, share));
  return text;
}

std::string secondsAfter(const ros::Time& begin, const ros::Time& time) {
  return secondsText((time - begin).toSec(), 3);
}

/// A heading, the first items, and the number of those left out.
std::string list(const std::string& heading, const std::vector<std::string>& items) {
  return heading + "\n" + (items.empty() ? "" : "  " + firstOf(items, kNamed, "\n  ", "\n  and ") + "\n");
}

/// A reason with the parts that differ between pairs and cycles replaced: links' names by *, numbers by #.
std::string kindOf(std::string reason, const std::vector<std::string>& names) {
  for (const std::string& body : names) {
    for (std::size_t at = reason.find(body); !body.empty() && at != std::string::npos; at = reason.find(body, at + 1)) {
      reason.replace(at, body.size(), "*");
    }
  }
  return std::regex_replace(reason, std::regex("[0-9]+([.][0-9]+)?"), "#");
}

}  // namespace

void CycleStatistics::add(const ContactArray& message, const CycleRecord& record) {
  if (record.isGap()) return gaps_.push_back(record);
  cycles_.push_back(record);
  late_frames_.insert(message.cycle.late_frames.begin(), message.cycle.late_frames.end());
  contacts_.add(message);
  for (const PairContact& pair : message.pairs) {
    Count& count = pairs_[pairName(pair.body_a, pair.body_b)];
    count.in_contact += pair.verdict == numberOf(Verdict::kContact);
    count.uncertain += pair.verdict == numberOf(Verdict::kUncertain);
    if (pair.verdict == numberOf(Verdict::kNotChecked)) count.addUnchecked(pair.reason, {pair.body_a, pair.body_b});
  }
  for (const UncheckedBody& body : message.unchecked) bodies_[body.body].addUnchecked(body.reason, {body.body});
}

void CycleStatistics::Count::addUnchecked(const std::string& why, const std::vector<std::string>& names) {
  ++not_checked;
  if (!reason.empty() || why.empty()) return;
  reason = why;
  kind = kindOf(why, names);
}

bool CycleStatistics::hasCheckedCycle() const {
  return std::any_of(cycles_.begin(), cycles_.end(),
                     [](const CycleRecord& cycle) { return cycle.verdict != Verdict::kNotChecked; });
}

std::string CycleStatistics::whyNotChecked() const {
  const std::vector<Unchecked> reasons = unchecked();
  return reasons.empty() ? "" : reasons.front().example;
}

std::string CycleStatistics::summary(const ros::Time& begin) const {
  const std::string found = contactLines(begin) + uncertainLines();
  std::string text = verdictLine() + reasonLines() + timeLine(begin) + gapLines(begin);
  text += hasCheckedCycle() ? found + notCheckedLines() : notCheckedLines() + found;
  text += jumpLines(begin) + contradictedLine(begin);
  for (const std::string& line : runTimesAndBounds()) text += line + "\n";
  return text;
}

std::string CycleStatistics::verdictLine() const {
  std::string text = "cycles           " + std::to_string(cycles_.size()) + ":";
  for (const Verdict verdict : {Verdict::kClear, Verdict::kNotChecked, Verdict::kUncertain, Verdict::kContact}) {
    const auto count = std::count_if(cycles_.begin(), cycles_.end(),
                                     [&](const CycleRecord& cycle) { return cycle.verdict == verdict; });
    text += (verdict == Verdict::kClear ? " " : ", ") + std::to_string(count) + " " + toString(verdict);
  }
  return text + "\n";
}

/// Why whole cycles are NOT_CHECKED, the most frequent reason first. Reasons that differ only by numbers are counted
/// together, and one of them is printed.
std::string CycleStatistics::reasonLines() const {
  std::map<std::string, std::pair<std::size_t, std::string>> by_kind;
  for (const CycleRecord& cycle : cycles_) {
    if (cycle.verdict != Verdict::kNotChecked) continue;
    auto& [count, example] = by_kind[kindOf(cycle.reason, {})];
    if (count++ == 0) example = cycle.reason;
  }
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [kind, reason] : by_kind) sorted.push_back(reason);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> items;
  for (const auto& [count, reason] : sorted) items.push_back(std::to_string(count) + " cycles: " + reason);
  return items.empty() ? "" : list("NOT_CHECKED as", items);
}

std::string CycleStatistics::timeLine(const ros::Time& begin) const {
  if (cycles_.empty()) return "";
  const CycleRecord& last = cycles_.back();
  std::string text =
      "time             from " + secondsAfter(begin, cycles_.front().start) + " to " + secondsAfter(begin, last.end);
  if (last.complete_until < last.end)
    text +=
        ", of some pairs only to " + secondsAfter(begin, last.complete_until) + " or more, where their transforms end";
  return text + "\n";
}

std::vector<std::string> CycleStatistics::gaps(const ros::Time& begin) const {
  std::vector<std::string> lines;
  for (const CycleRecord& gap : gaps_) {
    lines.push_back("from " + secondsAfter(begin, gap.start) + " to " + secondsAfter(begin, gap.end) + ", as " +
                    gap.reason);
  }
  return lines;
}

double CycleStatistics::longestGap() const {
  double longest = 0.0;
  for (const auto* records : {&cycles_, &gaps_})
    for (const CycleRecord& record : *records) longest = std::max(longest, (record.end - record.start).toSec());
  return longest;
}

std::string CycleStatistics::gapLines(const ros::Time& begin) const {
  if (gaps_.empty()) return "";
  double length = 0.0;
  for (const CycleRecord& gap : gaps_) length += (gap.end - gap.start).toSec();
  return list("no cycle         for " + durationText(length), gaps(begin));
}

std::string CycleStatistics::jumpLines(const ros::Time& begin) const {
  std::vector<std::string> items;
  for (std::size_t i = 1; i < cycles_.size(); ++i) {
    if (cycles_[i].start >= cycles_[i - 1].end) continue;
    items.push_back("from " + secondsAfter(begin, cycles_[i - 1].end) + " to " + secondsAfter(begin, cycles_[i].start));
  }
  return items.empty() ? "" : list("time jumped back and the monitor was reset", items);
}

std::string CycleStatistics::contactLines(const ros::Time& begin) const {
  std::vector<std::string> items;
  for (const Contact& contact : contacts_.contacts()) {
    if (contact.verdict != numberOf(Verdict::kContact)) continue;
    // Of a contact without shell points no depth is known.
    const bool is_felt = contact.deepest.depth > 0.0 || contact.contact_error_bound == 0.0;
    const double depth = is_felt ? contact.deepest.depth : contact.deepest.depth_error;
    items.push_back(pairName(contact.body_a, contact.body_b) + ": at " + secondsAfter(begin, contact.begin) + " for " +
                    durationText((contact.end - contact.begin).toSec()) + (is_felt ? ", " : ", at most ") +
                    lengthText(depth) + " deep" + (contact.seen_at_samples ? "" : ", between samples"));
  }
  const auto pairs = std::count_if(pairs_.begin(), pairs_.end(), [](const auto& p) { return p.second.in_contact > 0; });
  return list("contact          " + counted(std::size_t(pairs), "pair") + ", " + counted(items.size(), "time"), items);
}

std::string CycleStatistics::uncertainLines() const {
  std::vector<std::string> items;
  for (const auto& [name, count] : pairs_) {
    if (count.uncertain > 0) items.push_back(name + ": in " + counted(std::size_t(count.uncertain), "cycle"));
  }
  return list("uncertain        " + counted(items.size(), "pair") + ", in at least one cycle", items);
}

/// Grouped by reason, the most frequent first.
std::vector<CycleStatistics::Unchecked> CycleStatistics::unchecked() const {
  std::map<std::string, Unchecked> reasons;
  const auto addAll = [&](const std::map<std::string, Count>& counts, std::size_t Unchecked::*kind) {
    for (const auto& [name, count] : counts) {
      if (count.not_checked == 0) continue;
      Unchecked& reason = reasons[count.kind];
      if (count.not_checked > reason.most_cycles) reason.example = name + ": " + count.reason;
      ++(reason.*kind);
      reason.cycles += count.not_checked;
      reason.most_cycles = std::max(reason.most_cycles, count.not_checked);
    }
  };
  addAll(bodies_, &Unchecked::bodies);
  addAll(pairs_, &Unchecked::pairs);
  std::vector<Unchecked> sorted;
  for (const auto& [kind, reason] : reasons) sorted.push_back(reason);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Unchecked& a, const Unchecked& b) {
    return std::tie(a.most_cycles, a.cycles) > std::tie(b.most_cycles, b.cycles);
  });
  return sorted;
}

std::string CycleStatistics::notCheckedLines() const {
  const auto bodiesAndPairs = [](std::size_t bodies, std::size_t pairs) {
    const std::string of_bodies = bodies == 1 ? "1 body" : std::to_string(bodies) + " bodies",
                      of_pairs = counted(pairs, "pair");
    return bodies == 0 ? of_pairs : pairs == 0 ? of_bodies : of_bodies + " and " + of_pairs;
  };
  std::size_t bodies = 0, pairs = 0;
  std::vector<std::string> items;
  for (const Unchecked& reason : unchecked()) {
    bodies += reason.bodies;
    pairs += reason.pairs;
    items.push_back(bodiesAndPairs(reason.bodies, reason.pairs) + ", in up to " +
                    counted(std::size_t(reason.most_cycles), "cycle") + ", as " + reason.example);
  }
  return list("not checked      " + bodiesAndPairs(bodies, pairs) + ", in at least one cycle", items);
}

/// Empty if no transforms arrived late, after the cycle that needed them.
std::string CycleStatistics::contradictedLine(const ros::Time& begin) const {
  const auto isContradicting = [](const CycleRecord& cycle) { return !cycle.contradicted_since.isZero(); };
  const auto first = std::find_if(cycles_.begin(), cycles_.end(), isContradicting);
  if (first == cycles_.end()) return "";
  const auto count = std::count_if(first, cycles_.end(), isContradicting);
  return "late transforms  in " + std::to_string(count) + " cycles, the first at " + secondsAfter(begin, first->end) +
         ": results of earlier cycles are invalid from contradicted_since on, see cycles.csv; the first of " +
         std::to_string(late_frames_.size()) + " frames: " + *late_frames_.begin() + "\n";
}

std::vector<std::string> CycleStatistics::runTimesAndBounds() const {
  std::vector<double> run_times, bounds;
  for (const CycleRecord& cycle : cycles_) {
    run_times.push_back(cycle.run_time);
    if (cycle.hasBound()) bounds.push_back(cycle.error_bound);
  }
  std::vector<std::string> lines;
  if (!run_times.empty()) {
    lines.push_back("run time         " + quantiles(run_times, {0.5, 0.99, 1.0}) + " ms (median / 99 % / longest)");
  }
  if (!bounds.empty()) {
    lines.push_back("error bound      " + quantiles(bounds, {0.5, 1.0}) + " mm (median / largest)");
  }
  return lines;
}

}  // namespace sdf_ccd::tools
