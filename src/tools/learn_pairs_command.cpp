#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "common/counted.h"
#include "common/number_text.h"
#include "interrupt.h"
#include "output_file.h"
#include "progress_bar.h"
#include "robot/robot_files.h"
#include "robot/srdf_pairs.h"
#include "robot_monitor/learn_pairs.h"
#include "scene/name_pair.h"
#include "threads_option.h"
#ifdef SDF_CCD_WITH_ROS
#include "ros/bag/recorded_positions.h"
#endif

namespace sdf_ccd::tools {
namespace {

constexpr std::size_t kUnknown = 10;  // printed pairs that are not learned: their reasons are often the same

struct LearnPairsArguments {
  std::string urdf, srdf, out, bag, topic;
  long states = 10'000;
  long seed = 1;
  ThreadsOption threads;
  double max_error = 0.005;
  bool default_pairs = false;
};

/// A progress bar for each part of the work.
class Bars {
 public:
  void show(const std::string& what, double share) {
    if (what != what_) {
      bar_.reset();  // ends its line
      bar_ = std::make_unique<ProgressBar>(what);
      what_ = what;
    }
    (*bar_)(share);
  }

 private:
  std::string what_;
  std::unique_ptr<ProgressBar> bar_;
};

/// @param most  at most so many are printed.
void printList(const std::string& heading, const std::vector<PairDecision>& pairs,
               std::size_t most = std::numeric_limits<std::size_t>::max()) {
  if (pairs.empty()) return;
  std::cout << heading << pairs.size() << "\n";
  for (std::size_t i = 0; i < std::min(most, pairs.size()); ++i) {
    const PairDecision& pair = pairs[i];
    std::cout << "  " << pairName(pair.body_a, pair.body_b) << (pair.text.empty() ? "" : ": " + pair.text) << "\n";
  }
  if (pairs.size() > most) std::cout << "  and " << pairs.size() - most << " more\n";
}

void printReport(const LearnedPairs& pairs) {
  std::map<std::string, std::size_t> reasons;
  for (const PairDecision& pair : pairs.disabled) ++reasons[srdfReason(pair.kind)];
  const std::size_t states = 1 + pairs.states + pairs.recorded;
  std::cout << "states           " << pairs.states << " random (seed " << pairs.seed << "), " << pairs.recorded
            << " recorded, and the default\n"
            << "time             " << durationText(pairs.build_seconds) << " for fields and shells, "
            << durationText(pairs.test_seconds)
            << " for the states: " << shortText(1e3 * pairs.test_seconds / double(states)) << " ms each\n"
            << "error bound      " << lengthText(pairs.error_bound) << "\n"
            << "no check needed  " << pairs.disabled.size();
  for (const auto& [reason, count] : reasons) std::cout << ", " << count << " " << reason;
  std::cout << "\n";
  if (pairs.known > 0) std::cout << "as given         " << pairs.known << "\n";
  printList("touch            ", pairs.touching);
  printList("close            ", pairs.close);
  printList("not learned      ", pairs.unknown, kUnknown);
  printList("touch at default ", pairs.at_default);
  std::cout << std::flush;
}

LearnOptions learnOptions(const LearnPairsArguments& arguments, const RobotModel& robot) {
  LearnOptions options;
  options.states = static_cast<std::size_t>(arguments.states);
  options.seed = static_cast<std::uint64_t>(arguments.seed);
  options.max_error = arguments.max_error;
  options.default_pairs = arguments.default_pairs;
#ifdef SDF_CCD_WITH_ROS
  std::string warning;
  if (!arguments.bag.empty()) options.recorded = recordedPositions(arguments.bag, robot, arguments.topic, warning);
  if (!warning.empty()) std::cerr << "sdf_ccd: warning: " << warning << std::endl;
#else
  static_cast<void>(robot);
#endif
  return options;
}

void run(const LearnPairsArguments& arguments) {
  if (arguments.states < 0) throw std::runtime_error("--states must not be negative");
  if (arguments.states == 0 && arguments.bag.empty()) throw std::runtime_error("--states 0 needs --bag");
  if (arguments.seed < 0) throw std::runtime_error("--seed must not be negative");
  if (!(arguments.max_error > 0.0)) throw std::runtime_error("--max-error must be positive");
  const auto limit = arguments.threads.limit();
  const LoadedRobot robot = loadRobot(arguments.urdf, arguments.srdf);
  LearnOptions options = learnOptions(arguments, robot.model);
  const Interrupt interrupt;
  OutputFile out(arguments.out);
  LearnedPairs pairs;
  try {
    Bars bars;
    options.progress = [&](const std::string& what, double share) { bars.show(what, share); };
    interrupt.during([&] { pairs = learnPairs(robot.model, robot.srdf, robot.loader, options); });
  } catch (const Interrupted&) {
    throw std::runtime_error("interrupted: nothing is written to " + arguments.out);
  }
  for (const std::string& warning : pairs.warnings) std::cerr << "sdf_ccd: warning: " << warning << std::endl;
  out.stream() << srdfWith(pairs, robot.model, robot.srdf_text);
  out.commit();
  printReport(pairs);
  if (pairs.unknown.empty()) return;
  std::cerr << "sdf_ccd: " << counted(pairs.unknown.size(), "pair") << " could not be classified, for example "
            << pairName(pairs.unknown.front().body_a, pairs.unknown.front().body_b) << ": "
            << pairs.unknown.front().text << std::endl;
  throw PartlyDone();
}

}  // namespace

void addLearnPairsCommand(CLI::App& app) {
  auto arguments = std::make_shared<LearnPairsArguments>();
  CLI::App* command = app.add_subcommand("learn-pairs", "Write an SRDF of the pairs of links that need no check");
  command->footer(
      "Adjacent: joined by one joint. Always: touch in all of the states, deeper than the error bound, or as "
      "neighbours come within 1 mm in all of them. Never: farther apart than it in all of them, which is not a proof; "
      "the file gives the number of states tested. States are drawn within the joints' limits, a quarter of them with "
      "joints at their limits; mimic joints follow, continuous ones take a full revolution, or more if what follows "
      "them needs more. The same seed gives the same file. What a given SRDF holds is kept. Exit code 1: nothing is "
      "learned of some pairs, as a mesh is missing or a joint "
      "has no bounds.");
  command->add_option("--urdf", arguments->urdf, "The robot; package:// is looked up in ROS_PACKAGE_PATH")->required();
  command->add_option("--out", arguments->out, "SRDF file to write")->required();
  command->add_option("--srdf", arguments->srdf, "SRDF to start from: all that it holds is kept");
  command->add_option("--states", arguments->states, "Random states; default 10000");
  command->add_option("--seed", arguments->seed, "Seed of the random states; default 1");
  arguments->threads.addTo(*command);
  command->add_option("--max-error", arguments->max_error,
                      "Error bound [m]: pairs that come nearer than this are not left out; default 0.005");
  command->add_flag("--default", arguments->default_pairs,
                    "Also leave out pairs that touch, or are UNCERTAIN, where all joints are at zero, but not always");
#ifdef SDF_CCD_WITH_ROS
  command->add_option("--bag", arguments->bag, "Bag whose joint states are tested too; --states 0: these alone");
  command->add_option("--joint-states", arguments->topic, "Topic of them; default all of the bag");
#endif
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
