#include "ros/monitor/diagnostics.h"

#include <stdexcept>

namespace sdf_ccd {
namespace {

constexpr double kRateTolerance = 0.1;
constexpr int kRateWindow = 10;               // number of updates, which come once a second
const ros::WallDuration kReportPeriod(0.05);  // between tests whether a second has passed

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

void addLines(const std::string& key, const std::vector<std::string>& lines, DiagnosticStatusWrapper& status) {
  for (const std::string& line : lines) status.add(key, line);
}

}  // namespace

Diagnostics::Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name)
    : updater_(node, private_node, name),
      rate_({&least_rate_, &largest_rate_, kRateTolerance, kRateWindow}, "rate"),
      worker_(2, [this](const Report& report) { publish(report); }) {
  updater_.setHardwareID("none");
  updater_.add("cycles", [this](DiagnosticStatusWrapper& status) { cycles(status); });
  updater_.add("transforms", [this](DiagnosticStatusWrapper& status) { transforms(status); });
  updater_.add("bodies", [this](DiagnosticStatusWrapper& status) { bodies(status); });
}

void Diagnostics::update(const MonitorHealth& health, bool at_once) {
  at_once_ |= at_once;
  const ros::WallTime now = ros::WallTime::now();
  if (!at_once_ && now - reported_at_ < kReportPeriod) return;
  Report* const report = worker_.tryNext();
  if (!report) return;  // the next call reports
  report->health = health;
  report->at_once = at_once_;
  at_once_ = false;
  reported_at_ = now;
  worker_.handOver();
}

void Diagnostics::publish(const Report& report) {
  health_ = report.health;
  // The rate is measured on the ROS clock, which a player may run at any speed.
  const bool is_real = !ros::Time::isSimTime();
  least_rate_ = is_real && health_.is_timed ? health_.wanted_rate : 0.0;
  largest_rate_ = is_real ? health_.wanted_rate : std::numeric_limits<double>::infinity();
  try {
    report.at_once ? updater_.force_update() : updater_.update();
  } catch (const std::exception&) {
    rate_.clear();  // the clock was set by more than a ros::Duration can hold, so the updater's subtraction threw
  }
}

void Diagnostics::tick() {
  if (!ticks_) {
    ticks_ = true;
    rate_.clear();
    updater_.add(rate_);
  }
  rate_.tick();
}

void Diagnostics::cycles(DiagnosticStatusWrapper& status) const {
  if (!health_.failure.empty()) {
    status.summary(DiagnosticStatus::ERROR, health_.failure);
  } else if (!health_.building.empty()) {
    status.summary(DiagnosticStatus::WARN, health_.building);
  } else if (!health_.stall.empty()) {
    status.summary(DiagnosticStatus::ERROR, health_.stall + ": nothing is checked");
  } else if (health_.safety == Health::kError) {
    status.summary(DiagnosticStatus::ERROR, health_.finding);
  } else if (health_.safety == Health::kWarn) {
    status.summary(DiagnosticStatus::WARN, health_.finding);
  } else if (health_.run_time * health_.wanted_rate > 1.0) {
    status.summary(DiagnosticStatus::WARN, "checking a cycle takes longer than its period, 1/rate");
  } else if (health_.pairs_postponed + health_.pairs_incomplete > 0) {
    status.summaryf(DiagnosticStatus::WARN,
                    "the cycle's time (max_cycle_time) was used up: %d pairs are postponed, %d contacts incomplete",
                    health_.pairs_postponed, health_.pairs_incomplete);
  } else if (health_.max_error > 0.0 && health_.error.total() > health_.max_error) {
    status.summary(DiagnosticStatus::WARN, "running, but the error bound exceeds the parameter max_error");
  } else if (!health_.standing.empty()) {
    status.summary(DiagnosticStatus::WARN, "running; " + health_.standing.front());
  } else {
    status.summary(DiagnosticStatus::OK, "running");
  }
  addLines("warning", health_.standing, status);
  status.addf("rate [Hz]", "%.1f", health_.rate);
  status.addf("latency [ms]", "%.1f", 1e3 * health_.latency);
  status.addf("run time [ms]", "%.2f", 1e3 * health_.run_time);
  status.addf("error bound [mm]", "%.3f", 1e3 * health_.error.total());
  status.addf("error bound: chords and motion [mm]", "%.3f", 1e3 * health_.error.chord);
  status.addf("error bound: gaps between points [mm]", "%.3f", 1e3 * health_.error.gap);
  status.addf("error bound of contacts [mm]", "%.3f", 1e3 * health_.contact_error);
  status.add("pairs", health_.pairs);
  status.add("pairs left out", health_.pairs_left_out);
  status.add("cycles with postponed pairs", health_.short_cycles);
}

void Diagnostics::transforms(DiagnosticStatusWrapper& status) const {
  if (!health_.stall.empty()) {
    status.summary(DiagnosticStatus::ERROR, "no new transforms");
  } else if (!health_.missing.empty()) {
    status.summaryf(DiagnosticStatus::ERROR, "transforms of %zu bodies are missing", health_.missing.size());
  } else if (!health_.bad_joints.empty()) {
    status.summary(DiagnosticStatus::WARN, health_.bad_joints.front());
  } else if (!health_.contradicted.empty()) {
    status.summary(DiagnosticStatus::WARN, health_.contradicted);
  } else if (!health_.trigger_warning.empty()) {
    status.summary(DiagnosticStatus::WARN, health_.trigger_warning);
  } else if (health_.pairs_delayed > 0) {
    status.summaryf(DiagnosticStatus::WARN, "%d pairs wait for late transforms", health_.pairs_delayed);
  } else {
    status.summary(DiagnosticStatus::OK, "the transforms of all bodies are known");
  }
  addLines("missing", health_.missing, status);
  addLines("joint", health_.bad_joints, status);
  status.addf("age [ms]", "%.1f", 1e3 * health_.age);
  status.add("pairs delayed", health_.pairs_delayed);
  status.add("out of order", health_.ignored.out_of_order);
  status.add("invalid", health_.ignored.refused);
  status.add("dropped (frames of no body)", health_.ignored.not_kept);
}

void Diagnostics::bodies(DiagnosticStatusWrapper& status) const {
  if (!health_.bad_bodies.empty()) {
    status.summaryf(DiagnosticStatus::ERROR, "%zu bodies cannot be checked", health_.bad_bodies.size());
  } else if (!health_.warnings.empty()) {
    status.summaryf(DiagnosticStatus::WARN, "%zu warnings", health_.warnings.size());
  } else {
    status.summary(DiagnosticStatus::OK, "all bodies can be checked");
  }
  status.add("world version", health_.world_version);
  addLines("not checked", health_.bad_bodies, status);
  addLines("warning", health_.warnings, status);
}

}  // namespace sdf_ccd
