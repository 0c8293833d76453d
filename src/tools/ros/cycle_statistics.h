#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "contact_record.h"
#include "cycle_record.h"

namespace sdf_ccd::tools {

/// Counts a monitor's results, cycle by cycle, and summarises them in a few lines.
class CycleStatistics {
 public:
  /// @param record  toRecord() of the message.
  void add(const ContactArray& message, const CycleRecord& record);

  const std::vector<CycleRecord>& cycles() const { return cycles_; }

  /// Times over which no cycle was run, as "from 1.4 s to 4 s, as no new transforms", relative to `begin`.
  std::vector<std::string> gaps(const ros::Time& begin) const;
  /// The longest time between poses, within a cycle or while none was run [s].
  double longestGap() const;
  std::vector<Contact> contacts() const { return contacts_.contacts(); }

  /// Whether any cycle as a whole has a verdict other than NOT_CHECKED.
  bool hasCheckedCycle() const;

  /// "body: reason" or "body - body: reason", an example of the most frequent reason for NOT_CHECKED; empty if
  /// everything was checked.
  std::string whyNotChecked() const;

  /// Cycles by verdict, the time that was checked, pairs in contact, uncertain and not checked, run times and error
  /// bounds.
  /// @param begin  time zero of the summary.
  std::string summary(const ros::Time& begin) const;

  /// A line with the run times' median, 99th percentile and maximum, and one with the error bounds' median and maximum;
  /// either is left out if there is no data.
  std::vector<std::string> runTimesAndBounds() const;

 private:
  /// Counts of a pair, or of a body with all of its pairs.
  struct Count {
    std::size_t in_contact = 0, uncertain = 0, not_checked = 0;  // cycles
    std::string reason, kind;                                    // of the first NOT_CHECKED

    void addUnchecked(const std::string& why, const std::vector<std::string>& names);
  };

  /// Pairs and bodies that were not checked for the same reason, apart from names and numbers in its text.
  struct Unchecked {
    std::string example;  // "body - body: reason", "body: reason"
    std::size_t pairs = 0, bodies = 0, cycles = 0, most_cycles = 0;
  };

  std::vector<Unchecked> unchecked() const;
  std::string verdictLine() const;
  std::string reasonLines() const;
  std::string timeLine(const ros::Time& begin) const;
  std::string contactLines(const ros::Time& begin) const;
  std::string uncertainLines() const;
  std::string notCheckedLines() const;
  std::string gapLines(const ros::Time& begin) const;
  std::string jumpLines(const ros::Time& begin) const;
  std::string contradictedLine(const ros::Time& begin) const;

  std::vector<CycleRecord> cycles_, gaps_;
  ContactRecords contacts_;
  std::map<std::string, Count> pairs_;   // by "body - body"
  std::map<std::string, Count> bodies_;  // only those that were not checked
  std::set<std::string> late_frames_;
};

}  // namespace sdf_ccd::tools
