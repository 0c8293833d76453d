#include "cycle_statistics.h"

#include <algorithm>
#include <array>

#include "precision/error_summary.h"
#include "print.h"

namespace sdf_ccd::tools {
namespace {

constexpr std::size_t kNamed = 10;  // of a list in a summary

/// In thousandths, between slashes.
std::string quantiles(std::vector<double> values, const std::vector<double>& shares) {
  std::string text;
  for (const double share : shares)
    text += (text.empty() ? "" : " / ") + shortly(1e3 * precision::quantile(values, share));
  return text;
}

std::string nameOf(const std::string& body_a, const std::string& body_b) {
  return body_a + " - " + body_b;
}

std::string secondsSince(const ros::Time& begin, const ros::Time& time) {
  return rounded((time - begin).toSec(), 3) + " s";
}

/// A heading and the first of what it is about.
std::string list(const std::string& heading, const std::vector<std::string>& items) {
  std::string text = heading + "\n";
  for (std::size_t i = 0; i < std::min(kNamed, items.size()); ++i) text += "  " + items[i] + "\n";
  if (items.size() > kNamed) text += "  and " + std::to_string(items.size() - kNamed) + " more\n";
  return text;
}

}  // namespace

void CycleStatistics::add(const ContactArray& message) {
  cycles_.push_back(toRecord(message));
  late_frames_.insert(message.late_frames.begin(), message.late_frames.end());
  joiner_.add(message);
  for (const PairContact& pair : message.pairs) {
    PairCount& count = pairs_[nameOf(pair.body_a, pair.body_b)];
    count.in_contact += pair.verdict == PairContact::CONTACT;
    count.uncertain += pair.verdict == PairContact::UNCERTAIN;
    count.not_checked += pair.verdict == PairContact::NOT_CHECKED;
    if (count.reason.empty()) count.reason = pair.reason;
  }
}

std::vector<std::string> CycleStatistics::neverChecked() const {
  std::vector<std::string> lines;
  for (const auto& [name, count] : pairs_) {
    if (count.not_checked == cycles_.size()) lines.push_back(name + ": " + count.reason);
  }
  return lines;
}

std::string CycleStatistics::summary(const ros::Time& begin) const {
  std::string text = verdictLine() + timeLine(begin) + contactLines(begin) + uncertainLines() + notCheckedLines() +
                     contradictedLine(begin);
  for (const std::string& line : runTimesAndBounds()) text += line + "\n";
  return text;
}

std::string CycleStatistics::verdictLine() const {
  std::array<std::size_t, 4> counts = {};
  for (const CycleRecord& cycle : cycles_) ++counts[static_cast<std::size_t>(cycle.verdict)];
  std::string text = "cycles           " + std::to_string(cycles_.size()) + ":";
  for (std::size_t v = 0; v < counts.size(); ++v) {
    text += (v == 0 ? " " : ", ") + std::to_string(counts[v]) + " " + toString(static_cast<Verdict>(v));
  }
  return text + "\n";
}

std::string CycleStatistics::timeLine(const ros::Time& begin) const {
  if (cycles_.empty()) return "";
  const CycleRecord& last = cycles_.back();
  std::string text =
      "time             from " + secondsSince(begin, cycles_.front().start) + " to " + secondsSince(begin, last.end);
  if (last.delayed > 0) {
    text += ", " + std::to_string(last.delayed) + " pairs to " + secondsSince(begin, last.complete_until) +
            " or more, where their transforms end";
  }
  return text + "\n";
}

std::string CycleStatistics::contactLines(const ros::Time& begin) const {
  std::vector<std::string> items;
  for (const ContactRecord& contact : joiner_.contacts()) {
    if (contact.verdict != Verdict::kContact) continue;
    items.push_back(nameOf(contact.body_a, contact.body_b) + ": at " + secondsSince(begin, contact.start) + " for " +
                    shortly((contact.end - contact.start).toSec()) + " s, " + shortly(1e3 * contact.deepest.depth) +
                    " mm deep" + (contact.seen_at_samples ? "" : ", between samples"));
  }
  const auto pairs = std::count_if(pairs_.begin(), pairs_.end(), [](const auto& p) { return p.second.in_contact > 0; });
  return list("contact          " + std::to_string(pairs) + " pairs, " + std::to_string(items.size()) + " times",
              items);
}

std::string CycleStatistics::uncertainLines() const {
  std::vector<std::string> items;
  for (const auto& [name, count] : pairs_) {
    if (count.uncertain > 0) items.push_back(name + ": in " + std::to_string(count.uncertain) + " cycles");
  }
  return list("uncertain        " + std::to_string(items.size()) + " pairs, in some cycle", items);
}

std::string CycleStatistics::notCheckedLines() const {
  struct Group {
    std::size_t pairs = 0, most_cycles = 0;
  };
  std::map<std::string, Group> groups;  // by reason
  std::size_t pairs = 0;
  for (const auto& [name, count] : pairs_) {
    if (count.not_checked == 0) continue;
    Group& group = groups[count.reason];
    ++group.pairs;
    ++pairs;
    group.most_cycles = std::max(group.most_cycles, count.not_checked);
  }
  std::vector<std::string> items;
  for (const auto& [reason, group] : groups) {
    items.push_back(std::to_string(group.pairs) + " pairs, in up to " + std::to_string(group.most_cycles) +
                    " cycles: " + reason);
  }
  return list("not checked      " + std::to_string(pairs) + " pairs, in some cycle", items);
}

/// Empty if no transforms came late behind newer ones.
std::string CycleStatistics::contradictedLine(const ros::Time& begin) const {
  const auto isContradicting = [](const CycleRecord& cycle) { return !cycle.contradicted_since.isZero(); };
  const auto first = std::find_if(cycles_.begin(), cycles_.end(), isContradicting);
  if (first == cycles_.end()) return "";
  const auto count = std::count_if(first, cycles_.end(), isContradicting);
  return "late transforms  in " + std::to_string(count) + " cycles, the first at " + secondsSince(begin, first->end) +
         ": what earlier ones said does not hold from contradicted_since on, see cycles.csv; the first of " +
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
