#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include <console_bridge/console.h>
#include <fmt/format.h>

#include "common/counted.h"
#include "common/number_text.h"
#include "common/seconds_since.h"
#include "cycle_report.h"
#include "monitor/over_budget.h"
#include "monitor_config.h"
#include "monitor_scene.h"
#include "ros/bag/bag_check.h"
#include "ros/bag/checked_bag.h"
#include "ros/bag/pair_coverage.h"
#include "scene/name_pair.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/scene_output.h"
#include "tools/threads_option.h"

namespace sdf_ccd::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kFastestRate = 1e4;  // of cycles [Hz]; each cycle covers all pairs

struct CheckBagArguments {
  std::string bag;
  std::string out;
  MonitorConfig config;
  RecordedMotionOptions motion;
  ThreadsOption threads;
};

void require(bool is_good, const std::string& what) {
  if (!is_good) throw std::runtime_error(what);
}

/// The files of a check. Without commit() no file is left.
struct CheckFiles {
  explicit CheckFiles(const std::string& path)
      : directory(path),
        summary(directory.file("summary.txt")),
        plan(directory.file("plan.txt")),
        bag_path(directory.file("checked.bag")),
        bag(bag_path.part(), bag_path.path()),
        report(directory) {}

  /// @param origin  from which the plot's times count.
  /// @param title   title of the plot.
  void commit(const ros::Time& origin, const std::string& title) {
    bag.close();
    for (OutputFile* file : {&plan, &summary}) file->close();
    if (!report.commit(origin, title))
      std::cerr << "sdf_ccd: no error_time.svg: gnuplot is missing, or failed" << std::endl;
    bag_path.commit();
    for (OutputFile* file : {&plan, &summary}) file->commit();
  }

  Interrupt interrupt;  ///< an interrupted check leaves no files
  OutputDirectory directory;
  OutputFile summary, plan;
  OutputPath bag_path;
  BagWriter bag;
  CycleReport report;
};

/// Writes the monitor loop's results to the files, and shows progress.
class Recorder : public BagObserver {
 public:
  Recorder(const RecordedMotion& motion, const MonitorLoop& loop, CheckedBag& bag, CheckFiles& files)
      : begin_(motion.begin()),
        length_((motion.end() - begin_).toSec()),
        loop_(loop),
        bag_(bag),
        interrupt_(files.interrupt),
        report_(files.report) {}

  void onTransforms(const RecordedTransforms& transforms) override {
    bag_.addTransforms(transforms);
    if (interrupt_.requested()) throw Interrupted();
    bar_(length_ > 0.0 ? (transforms.recorded - begin_).toSec() / length_ : 1.0);
  }
  void onCycle(const ros::Time& now) override {
    if (interrupt_.requested()) throw Interrupted();
    const ContactArray contacts = toContactArray(loop_);
    bag_.addCycle(contacts, now);
    report_.add(contacts);
    coverage_.add(loop_.cycle(), loop_.result(), loop_.scene().pairs.size());
  }
  void onUnchecked(const std::string& reason, const ros::Time& now) override { bag_.addUnchecked(reason, now); }
  void onGap(const TimePart& part, const std::string& reason, const ros::Time& now) override {
    const ContactArray gap = toGap(loop_, part, reason);
    bag_.addGap(gap, now);
    report_.add(gap);
  }

  const PairCoverage& coverage() const { return coverage_; }

 private:
  ProgressBar bar_{"cycles"};
  ros::Time begin_;
  double length_;  // [s]
  const MonitorLoop& loop_;
  CheckedBag& bag_;
  const Interrupt& interrupt_;
  CycleReport& report_;
  PairCoverage coverage_;
};

struct Checked {
  double seconds = 0.0;  ///< run time
  PairCoverage coverage;
};

Checked check(const RecordedMotion& motion, const MonitorParameters& parameters, const DescribedScene& described,
              MonitorLoop& loop, CheckFiles& files) {
  const auto start = std::chrono::steady_clock::now();
  CheckedBag bag(files.bag, loop, described.scene, parameters);
  bag.addScene(described.scene, motion.begin());
  Recorder recorder(motion, loop, bag, files);
  checkBag(motion, parameters, loop, recorder);
  return {secondsSince(start), recorder.coverage()};
}

/// What to do about poses that are too far apart in time to be a motion; empty if none are.
std::string gapHint(const CycleStatistics& statistics, double max_cycle) {
  const double gap = statistics.longestGap();
  if (gap <= max_cycle) return {};
  return fmt::format(
      "the bag's poses are up to {:.3g} s apart, and what is longer than max_cycle ({:.3g} s) is no motion: set "
      "max_cycle "
      "in --config if the robot went straight from one to the next, or ask the service query_motions about such "
      "motions",
      gap, max_cycle);
}

void requireChecked(const CycleStatistics& statistics, const Scene& scene, const std::string& bag, double max_cycle) {
  const std::string gap_hint = gapHint(statistics, max_cycle);
  const std::string hint = gap_hint.empty() ? "" : "; " + gap_hint;
  const std::vector<CycleRecord>& cycles = statistics.cycles();
  const std::string why = statistics.whyNotChecked();
  require(!cycles.empty(),
          bag + ": no cycle: the robot's transforms are never known at the same time, or all of them are static");
  const bool is_checked =
      std::any_of(cycles.begin(), cycles.end(), [](const CycleRecord& cycle) { return cycle.hasBound(); });
  if (!is_checked && why.empty()) std::cerr << planTable(scene) << std::flush;  // an error is one line
  require(is_checked, bag + ": nothing could be checked, as " + (why.empty() ? "all pairs are left out" : why) + hint);
}

/// "1 pair was", "2 pairs were".
std::string were(std::size_t pairs) {
  return counted(pairs, "pair") + (pairs == 1 ? " was" : " were");
}

/// What was not checked, a sentence each; empty if everything was checked, up to the time that late frames may take.
/// @param begin  start time of the bag.
std::vector<std::string> whatIsMissing(const CycleStatistics& statistics, const Scene& scene,
                                       const PairCoverage& coverage, const ros::Time& begin,
                                       const TfTrackerOptions& tf) {
  const double max_latency = tf.max_latency;
  std::vector<std::string> missing;
  const std::string why = statistics.whyNotChecked();
  if (!statistics.hasCheckedCycle()) missing.push_back("no cycle was checked as a whole, as " + why);
  if (const std::size_t never = coverage.neverChecked(); never > 0) {
    missing.push_back(fmt::format("{} never checked, for example {}{}", were(never),
                                  pairName(scene, scene.pairs[coverage.firstNeverChecked()]),
                                  why.empty() ? "" : "; the most frequent reason: " + why));
  }
  if (const PairCoverage::Partly partly = coverage.partlyChecked(max_latency); partly.pairs > 0) {
    missing.push_back(fmt::format(
        "{} not checked for a part of the time, {} for {:.2f} of {:.2f} s; the reasons are in cycles.csv",
        were(partly.pairs), pairName(scene, scene.pairs[partly.worst]), partly.unchecked, coverage.total()));
  }
  if (const auto doubtful = coverage.doubtful(max_latency); !doubtful.empty()) {
    missing.push_back(
        fmt::format("{} left out, but may touch for a part of the time, {} for {:.2f} of {:.2f} s; the "
                    "reasons are in cycles.csv",
                    were(doubtful.size()), pairName(scene, doubtful[0]), doubtful[0].seconds, coverage.total()));
  }
  for (const std::string& gap : statistics.gaps(begin)) missing.push_back("nothing was checked " + gap);
  if (const std::string hint = gapHint(statistics, tf.max_cycle); !hint.empty()) missing.push_back(hint);
  return missing;
}

void run(const CheckBagArguments& arguments) {
  MonitorParameters parameters = readParameters(arguments.config);
  const std::string map_topic = std::exchange(parameters.live_map.topic, "");
  require(parameters.rate <= kFastestRate,
          "a rate of " + numberText(parameters.rate) + " Hz is above the largest, " + numberText(kFastestRate) + " Hz");
  DescribedScene described = describeMonitored(parameters, arguments.config.urdf);
  if (!map_topic.empty()) described.warnings.push_back("nothing is checked against the maps on " + map_topic);
  const RecordedMotion motion(arguments.bag, described, arguments.motion);
  const ScenePlan plan = planScene(described.scene, planOptions(parameters.scene));
  CheckFiles files(arguments.out);
  for (const std::string& warning : described.warnings) std::cerr << "sdf_ccd: warning: " << warning << std::endl;
  std::shared_ptr<const Scene> scene;
  buildSceneWithBar(
      [&](const SceneProgress& progress) { scene = buildDescribed(described, plan, parameters.scene, progress); },
      files.interrupt);
  const std::string over = overBudget(*scene);
  std::vector<std::string> warnings = described.warnings;
  if (!over.empty()) {
    std::cerr << "sdf_ccd: warning: " << over << std::endl;
    warnings.push_back(over);
  }
  MonitorLoop loop(scene, described, parameters);
  const Checked checked = check(motion, parameters, described, loop, files);
  std::vector<std::string> of_motion = motion.warnings();
  if (const TfIgnored ignored = loop.history().ignored(); ignored.refused > 0)
    of_motion.push_back(std::to_string(ignored.refused) + " transforms were refused, the last as " + ignored.refusal);
  std::vector<std::string> standing;
  loop.warnings().copyTo(standing);
  std::string lasting;  // at the end, where they are read
  for (const std::string& warning : standing) {
    lasting += warning + "\n";
    const bool is_of_scene =
        std::find(scene->overlap_notes.begin(), scene->overlap_notes.end(), warning) != scene->overlap_notes.end();
    if (!is_of_scene) of_motion.push_back(warning);
  }
  for (const std::string& warning : of_motion) {
    std::cerr << "sdf_ccd: warning: " << warning << std::endl;
    warnings.push_back(warning);
  }
  const CycleStatistics& statistics = files.report.statistics();
  requireChecked(statistics, *scene, arguments.bag, parameters.tf.max_cycle);

  const std::vector<std::string> missing =
      whatIsMissing(statistics, *scene, checked.coverage, motion.origin(), parameters.tf);
  for (const std::string& what : missing) std::cerr << "sdf_ccd: " << what << std::endl;
  const bool is_complete = areAllMade(*scene) && missing.empty();
  const double length = (motion.end() - motion.begin()).toSec();
  const std::string text = fmt::format(
      "bag              {}: {:.3f} s from {}, followed by {}\n"
      "robot            {}: {} bodies with the world's, {} pairs, fixed frame {}\n"
      "{}"
      "speed            {:.1f} s in {}: {:.3g} times real time\n"
      "{}",
      arguments.bag, length, timeText(motion.begin()), motion.source(), described.robot->urdf().getName(),
      scene->bodies.size(), scene->pairs.size(), described.fixed_frame, statistics.summary(motion.origin()), length,
      durationText(checked.seconds), length / checked.seconds, lasting);
  std::cout << text << std::flush;
  files.summary.stream() << text;
  files.plan.stream() << planText(*scene, warnings);
  files.commit(motion.origin(), "Error and run time of the cycles of " + fs::path(arguments.bag).filename().string());
  if (!is_complete) throw PartlyDone();
}

void checkThenRun(const CheckBagArguments& arguments) {
  require(arguments.motion.start >= 0.0, "--start must not be negative");
  require(arguments.motion.duration > 0.0, "--duration must be positive");
  require(!arguments.config.rate || *arguments.config.rate > 0.0, "--rate must be positive");
  require(!arguments.config.max_error || *arguments.config.max_error > 0.0, "--max-error must be positive");
  const auto limit = arguments.threads.limit();
  console_bridge::noOutputHandler();  // tf's own messages: the effects of broken transforms are reported
  try {
    run(arguments);
  } catch (const Interrupted&) {
    throw std::runtime_error("interrupted: nothing is written to " + arguments.out);
  }
}

}  // namespace

void addCheckBagCommand(CLI::App& app) {
  auto arguments = std::make_shared<CheckBagArguments>();
  CLI::App* command = app.add_subcommand("check-bag", "What the collision monitor finds in a recorded bag");
  command->footer(
      "Runs the monitor's cycles over the bag on the bag's own clock, without a roscore. The robot is followed by tf; "
      "links that joints move and tf does not name, by joint_states and the URDF. Writes to DIR: checked.bag "
      "(the transforms, and contacts, state, wrenches, markers, plan and world as the monitor publishes them, and "
      "distances and velocity_scale if their parameters are set; "
      "roslaunch sdf_ccd bag.launch "
      "check:=false shows it), cycles.csv (a row per cycle), contacts.csv (a row per pair and contact, over however "
      "many cycles it lasts), error_time.svg (gnuplot), summary.txt, plan.txt. Times are seconds, those of summary.txt "
      "and error_time.svg since the bag's first message; lengths metres. Exit "
      "code 1: some pairs were not checked at all, or not for more than max_latency in total, no cycle was checked as "
      "a "
      "whole, or a part of the bag was not, as its transforms end before it or are refused; 2: nothing was checked. "
      "Without gnuplot there is no "
      "error_time.svg, which does not change the exit code.");
  command->add_option("bag", arguments->bag, "Bag to read")->required();
  command->add_option("--urdf", arguments->config.urdf, "The robot; package:// is looked up in ROS_PACKAGE_PATH")
      ->required();
  command->add_option("--srdf", arguments->config.srdf, "Pairs that need no check");
  command->add_option("--out", arguments->out, "Directory to write to; made if it is missing")->required();
  command->add_option("--config", arguments->config.parameters, "The monitor's parameters, as config/monitor.yaml");
  command->add_option("--rate", arguments->config.rate,
                      "Cycles per second of the bag [Hz]; default as configured, else 30");
  command->add_option("--max-error", arguments->config.max_error,
                      "Error bound of verdicts decided by triangles [m], from 1e-5 to 1e-2");
  command->add_option("--start", arguments->motion.start, "Start time relative to the bag's beginning [s]; default 0");
  command->add_option("--duration", arguments->motion.duration, "How much of it to check [s]; default all");
  command->add_option(
      "--joint-states", arguments->motion.joint_states,
      "Topic of joint states, which are used rather than tf; default, for links that tf lacks: joint_states, "
      "else the only one");
  arguments->threads.addTo(*command);
  command->callback([arguments] { checkThenRun(*arguments); });
}

}  // namespace sdf_ccd::tools
