#include "cycle_report.h"

#include <regex>

#include "error_time_plot.h"

namespace sdf_ccd::tools {

CycleReport::CycleReport(const OutputDirectory& directory)
    : cycles_file_(directory.file("cycles.csv")),
      contacts_file_(directory.file("contacts.csv")),
      plot_file_(directory.file("error_time.svg")) {
  cycles_file_.stream() << cycleColumns();
  contacts_file_.stream() << contactColumns();
}

void CycleReport::add(const ContactArray& message) {
  // Where no cycle runs nothing is checked; where no time passes pairs may still catch up.
  const CycleStatus& cycle = message.cycle;
  const bool checks = cycle.checked + cycle.skipped + cycle.not_checked + cycle.postponed > 0;
  if (cycle.start == message.header.stamp && !checks) return;
  const CycleRecord record = toRecord(message);
  statistics_.add(message, record);
  cycles_file_.stream() << toRow(record);
}

bool CycleReport::commit(const ros::Time& origin, const std::string& title) {
  std::string subtitle = std::to_string(statistics_.cycles().size()) + " cycles";
  for (const std::string& line : statistics_.runTimesAndBounds()) {
    subtitle += ", " + std::regex_replace(line, std::regex(" +"), " ");
  }
  const bool is_plotted = plotErrorTime(statistics_.cycles(), origin, {title, subtitle}, plot_file_.part());
  for (const Contact& contact : statistics_.contacts()) contacts_file_.stream() << toRow(contact);
  for (OutputFile* file : {&cycles_file_, &contacts_file_}) file->close();
  for (OutputFile* file : {&cycles_file_, &contacts_file_}) file->commit();
  if (is_plotted) plot_file_.commit();
  return is_plotted;
}

}  // namespace sdf_ccd::tools
