#include <fcntl.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/MonitorState.h"
#include "tools/tool_run.h"

namespace sdf_ccd {
namespace {

using test::kBadInput;
using test::kDone;
using test::kPartlyDone;
using test::readText;
using test::ToolRun;

namespace fs = std::filesystem;

using Row = std::map<std::string, std::string>;  // by the column's name

constexpr double kBegin = 100.0, kPeriod = 1.0 / 30.0;  // [s]
constexpr int kBefore = 20, kAfter = 20;                // samples at rest
// config/demo/arm.urdf, with the hand pointing down: the finger stands upright, this far from the axis of yaw.
constexpr double kReach = 0.5, kTipHeight = 0.31, kFinger = 0.008;        // [m]
constexpr double kPlateY = 0.18, kPlateHalf = 0.0005;                     // config/demo/world.yaml [m]
constexpr double kFirstYaw = 0.2, kYawStep = 0.1, kLastYaw = 0.6 + 1e-9;  // [rad]

double timeOfYaw(double yaw) {
  return kBegin + kPeriod * (kBefore - 1 + (yaw - kFirstYaw) / kYawStep);
}

std::vector<Row> readCsv(const std::string& text) {
  std::istringstream lines(text);
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line + ",");
    std::vector<std::string> values;
    while (std::getline(cells, cell, ',')) values.push_back(cell);
    if (names.empty()) {
      names = values;
      continue;
    }
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = values.at(i);
  }
  return rows;
}

/// The demo's arm swings its finger through the demo's plate, so fast that no sample sees it there.
class CheckBag : public test::ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    ::setenv("ROS_PACKAGE_PATH", SDF_CCD_SOURCE_DIR, 1);
    const std::string world = readText(SDF_CCD_SOURCE_DIR "/config/demo/world.yaml");
    write("arm.yaml", world + "cache_directory: cache\nfield: {cell_size: 0.006}\nshell: {spacing: 0.003}\n");
    writeJointStates();
  }

  struct Pose {
    double shoulder, elbow, wrist;
  };

  /// With the hand pointing down at kReach.
  static Pose downwards() {
    constexpr double kUpperArm = 0.4, kForearm = 0.35, kHand = 0.212, kShoulderHeight = 0.35;
    const double h = kTipHeight + kHand - kShoulderHeight, d = std::hypot(kReach, h);
    const double lift = std::acos((kUpperArm * kUpperArm + d * d - kForearm * kForearm) / (2.0 * kUpperArm * d));
    const double shoulder = -(std::atan2(h, kReach) + lift);
    const double elbow =
        M_PI - std::acos((kUpperArm * kUpperArm + kForearm * kForearm - d * d) / (2.0 * kUpperArm * kForearm));
    return {shoulder, elbow, M_PI_2 - shoulder - elbow};
  }

  /// Eight seconds with the finger in the plate, as held.bag.
  /// @param is_silent  of the elbow, by the time [s]; all say nothing between `from` and `until`.
  void writeHeldContact(const std::function<bool(double)>& is_silent, double from = 9.0, double until = 9.0) {
    rosbag::Bag bag(path("held.bag").string(), rosbag::bagmode::Write);
    const Pose pose = downwards();
    for (int i = 0; i < 240; ++i) {
      const double time = kPeriod * i;
      if (time > from && time < until) continue;
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(kBegin + time);
      state.name = {"yaw", "shoulder", "wrist", "roll"};
      state.position = {std::asin(kPlateY / kReach) + 0.002 * std::sin(i), pose.shoulder, pose.wrist, 0.0};
      if (!is_silent(time)) {
        state.name.push_back("elbow");
        state.position.push_back(pose.elbow);
      }
      bag.write("joint_states", state.header.stamp + ros::Duration(0.005), state);
    }
  }

  /// Joint states of the sweep, stamped 5 ms before they are recorded.
  /// @param later  adds them again to the bag, recorded so much later [s].
  void writeJointStates(double later = 0.0) {
    const Pose pose = downwards();
    std::vector<double> yaws(kBefore - 1, kFirstYaw);
    for (double yaw = kFirstYaw; yaw < kLastYaw; yaw += kYawStep) yaws.push_back(yaw);
    yaws.insert(yaws.end(), kAfter, yaws.back());
    rosbag::Bag bag(path("arm.bag").string(), later > 0.0 ? rosbag::bagmode::Append : rosbag::bagmode::Write);
    for (std::size_t i = 0; i < yaws.size(); ++i) {
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(kBegin + kPeriod * double(i));
      state.name = {"yaw", "shoulder", "elbow", "wrist", "roll", "unknown"};
      state.position = {yaws[i], pose.shoulder, pose.elbow, pose.wrist, 0.0, 1.0};
      bag.write("joint_states", state.header.stamp + ros::Duration(0.005 + later), state);
    }
  }

  /// The command line, with a configuration unless the options name one.
  std::string check(const std::string& bag, const std::string& out, const std::string& options = "") const {
    const std::string config = options.find("--config") == std::string::npos ? "--config arm.yaml " : "";
    return "check-bag " + bag + " --urdf " SDF_CCD_SOURCE_DIR "/config/demo/arm.urdf " + config + options + " --out " +
           out;
  }
  std::vector<Row> table(const std::string& name) const { return readCsv(readText(path(name))); }
};

TEST_F(CheckBag, FindsTheContactBetweenTwoSamples) {
  const ToolRun result = run(check("arm.bag", "made"));
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find("followed by joint_states"), std::string::npos) << result.out;
  EXPECT_EQ(readText(path("made/summary.txt")), result.out);
  EXPECT_NE(readText(path("made/plan.txt")).find("plate"), std::string::npos);

  const std::vector<Row> contacts = table("made/contacts.csv");
  ASSERT_EQ(contacts.size(), 1u) << readText(path("made/contacts.csv"));
  Row contact = contacts[0];
  EXPECT_EQ(contact["body_a"] + " " + contact["body_b"], "hand plate");
  EXPECT_EQ(contact["verdict"], "CONTACT");
  const double enter = timeOfYaw(std::asin((kPlateY - kPlateHalf - kFinger) / kReach));
  const double leave = timeOfYaw(std::asin((kPlateY + kPlateHalf + kFinger) / kReach));
  EXPECT_NEAR(std::stod(contact["start"]), enter, 1e-3);
  EXPECT_NEAR(std::stod(contact["end"]), leave, 1e-3);
  EXPECT_EQ(contact["seen_at_samples"], "0");
  EXPECT_NEAR(std::stod(contact["depth"]), kFinger, 1e-3);  // the plate's middle at the finger's axis
  EXPECT_NEAR(std::stod(contact["y"]), kPlateY, kPlateHalf + 1e-3);
  EXPECT_GT(std::stod(contact["error_bound"]), 0.003);
}

TEST_F(CheckBag, HasARowForEveryCycleWithoutAGap) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  std::vector<Row> cycles = table("made/cycles.csv");
  ASSERT_GT(cycles.size(), 38u);
  double deepest = 0.0;
  int in_contact = 0;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    EXPECT_EQ(cycles[i]["t0"], cycles[i > 0 ? i - 1 : 0][i > 0 ? "t1" : "t0"]);
    EXPECT_GT(std::stod(cycles[i]["t1"]), std::stod(cycles[i]["t0"]));
    EXPECT_GT(std::stod(cycles[i]["run_time"]), 0.0);
    EXPECT_GT(std::stod(cycles[i]["error_bound"]), 0.0);
    EXPECT_EQ(cycles[i]["not_checked"] + cycles[i]["delayed"], "00");
    deepest = std::max(deepest, std::stod(cycles[i]["depth"]));
    in_contact += cycles[i]["verdict"] == "CONTACT";
  }
  EXPECT_EQ(in_contact, 1);
  EXPECT_NEAR(deepest, kFinger, 1e-3);
}

TEST_F(CheckBag, WritesABagThatHoldsWhatTheMonitorPublishes) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  std::map<std::string, std::size_t> counts;
  rosbag::Bag bag(path("made/checked.bag").string());
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    ++counts[message.getTopic()];
    if (const auto state = message.instantiate<MonitorState>()) {
      EXPECT_GT(state->run_time, 0.0);
      EXPECT_GT(state->error_bound, 0.0);
      EXPECT_EQ(state->header.frame_id, "base");
    }
  }
  const std::size_t cycles = table("made/cycles.csv").size();
  EXPECT_EQ(counts["/collision_monitor/contacts"], cycles);
  EXPECT_EQ(counts["/collision_monitor/state"], cycles);
  EXPECT_EQ(counts["/collision_monitor/wrenches/hand"], 1u);
  EXPECT_GE(counts["/collision_monitor/markers"], 2u);  // shown, and deleted
  EXPECT_EQ(counts["/collision_monitor/plan"], 1u);
  EXPECT_EQ(counts["/collision_monitor/world"], 1u);
  EXPECT_EQ(counts["/tf_static"], 1u);
  EXPECT_EQ(counts["/tf"], std::size_t(kBefore + 4 + kAfter));
}

TEST_F(CheckBag, TfAndRatesAndPlotsTellTheSameContacts) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  const std::string contacts = readText(path("made/contacts.csv"));

  // The checked bag holds tf, made from the joint states.
  const ToolRun again = run(check("made/checked.bag", "again"));
  ASSERT_EQ(again.exit_code, kDone) << again.error;
  EXPECT_NE(again.out.find("followed by tf\n"), std::string::npos) << again.out;
  EXPECT_EQ(readText(path("again/contacts.csv")), contacts);

  const ToolRun plot = run("plot-bag made/checked.bag --out plot");
  EXPECT_LE(plot.exit_code, kPartlyDone) << plot.error;  // partly without gnuplot
  EXPECT_EQ(readText(path("plot/contacts.csv")), contacts);
  EXPECT_EQ(readText(path("plot/cycles.csv")), readText(path("made/cycles.csv")));
  EXPECT_EQ(std::filesystem::exists(path("plot/error_time.svg")), plot.exit_code == kDone);

  // Cycles that end within the contact cut it; the table joins it again.
  ASSERT_EQ(run(check("arm.bag", "often", "--rate 200 --threads 1")).exit_code, kDone);
  Row once = table("made/contacts.csv")[0], often = table("often/contacts.csv").at(0);
  EXPECT_EQ(table("often/contacts.csv").size(), 1u);
  EXPECT_NEAR(std::stod(once["start"]), std::stod(often["start"]), 1e-6);
  EXPECT_NEAR(std::stod(once["end"]), std::stod(often["end"]), 1e-6);
}

struct Touch {
  double from, until;  // from the cycle's start [s]
  double depth, depth_error;
};

/// A message of one pair of links, as a monitor would send it of a cycle of 0.1 s; its verdict is the truth.
ContactArray toldOf(std::uint8_t verdict, double start, const std::vector<Touch>& touches) {
  ContactArray message;
  message.cycle_start = ros::Time(start);
  message.header.stamp = message.complete_until = ros::Time(start + 0.1);
  message.verdict = verdict;
  message.checked = 1;
  message.pairs.resize(1);
  PairContact& pair = message.pairs[0];
  pair.body_a = "a";
  pair.body_b = "b";
  pair.verdict = verdict;
  pair.error_field = 0.003;
  pair.error_chord = 0.0001;
  pair.error_gap = 0.001;
  pair.error_bound = message.error_bound = 0.0041;
  for (const Touch& touch : touches) {
    TimeInterval interval;
    interval.start = message.cycle_start + ros::Duration(touch.from);
    interval.end = message.cycle_start + ros::Duration(touch.until);
    pair.intervals.push_back(interval);
    PointContact point;
    point.enter = point.time = interval.start;
    point.exit = interval.end;
    point.depth = touch.depth;
    point.depth_error = touch.depth_error;
    pair.points.push_back(point);
    if (point.depth >= pair.deepest.depth) pair.deepest = point;
  }
  pair.depth = pair.deepest.depth;
  return message;
}

TEST_F(CheckBag, TheTableSaysOfContactsWhatTheMessagesSay) {
  struct Case {
    std::vector<ContactArray> told;
    std::string verdicts;  // of the rows
  };
  constexpr std::uint8_t kContact = PairContact::CONTACT, kUncertain = PairContact::UNCERTAIN;
  const std::vector<Case> cases = {
      // Less deep than the field's largest error, but deeper than that of its location.
      {{toldOf(kContact, kBegin, {{0.0, 0.02, 0.001, 0.0002}})}, "CONTACT "},
      // As of an open mesh: deeper than the error bound, but perhaps only inside a cap.
      {{toldOf(kUncertain, kBegin, {{0.0, 0.02, 0.01, 0.01}})}, "UNCERTAIN "},
      // Surfaces that are known to cross, although no depth shows it.
      {{toldOf(kContact, kBegin, {{0.0, 0.02, 0.0, 0.0}})}, "CONTACT "},
      // Of two times within a cycle, one is proved.
      {{toldOf(kContact, kBegin, {{0.0, 0.02, 0.0001, 0.0002}, {0.03, 0.05, 0.001, 0.0002}})}, "UNCERTAIN CONTACT "},
      // One contact over two cycles: the second proves it, although it is less deep there.
      {{toldOf(kUncertain, kBegin, {{0.05, 0.1, 0.002, 0.003}}),
        toldOf(kContact, kBegin + 0.1, {{0.0, 0.05, 0.001, 0.0002}})},
       "CONTACT "},
  };
  for (const Case& each : cases) {
    {
      rosbag::Bag bag(path("told.bag").string(), rosbag::bagmode::Write);
      for (const ContactArray& message : each.told) bag.write("contacts", message.header.stamp, message);
    }
    const ToolRun result = run("plot-bag told.bag --out told");
    EXPECT_LE(result.exit_code, kPartlyDone) << result.error;
    std::string verdicts;
    for (Row contact : table("told/contacts.csv")) verdicts += contact["verdict"] + " ";
    EXPECT_EQ(verdicts, each.verdicts);
  }
}

TEST_F(CheckBag, TfOfTheBaseGoesWithJointStates) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  {
    rosbag::Bag bag(path("arm.bag").string(), rosbag::bagmode::Append);
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    geometry_msgs::TransformStamped& transform = message.transforms[0];
    transform.header.frame_id = "/odom";
    transform.child_frame_id = "/base";
    transform.transform.rotation.w = 1.0;
    for (double time = kBegin; time < kBegin + 2.0; time += kPeriod) {
      transform.header.stamp = ros::Time(time);
      bag.write("/tf", transform.header.stamp, message);
    }
    bag.write("/controller/joint_states", ros::Time(kBegin), sensor_msgs::JointState());  // not the robot's
  }
  write("odom.yaml", readText(path("arm.yaml")) + "fixed_frame: odom\n");
  const ToolRun result = run(check("arm.bag", "odom", "--config odom.yaml"));
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find("followed by joint_states"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("fixed frame odom"), std::string::npos) << result.out;
  Row still = table("made/contacts.csv").at(0), moved = table("odom/contacts.csv").at(0);
  EXPECT_NEAR(std::stod(still["start"]), std::stod(moved["start"]), 1e-6);
  EXPECT_EQ(still["depth"], moved["depth"]);
  expectRefused(check("arm.bag", "no", "--joint-states /nowhere"), "holds no joint states on /nowhere");
}

TEST_F(CheckBag, TimeThatJumpsBackBeginsAnew) {
  writeJointStates(10.0);
  const ToolRun result = run(check("arm.bag", "made"));
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  const std::vector<Row> contacts = table("made/contacts.csv");
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(Row(contacts[0])["start"], Row(contacts[1])["start"]);
  bool has_cleared = false;
  rosbag::Bag bag(path("made/checked.bag").string());
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    const auto markers = message.instantiate<visualization_msgs::MarkerArray>();
    has_cleared |=
        markers && !markers->markers.empty() && markers->markers[0].action == visualization_msgs::Marker::DELETEALL;
  }
  EXPECT_TRUE(has_cleared);
}

TEST_F(CheckBag, AJointThatIsSilentInContactIsNeverClear) {
  // The finger stands in the plate all the time; the elbow says nothing from 3 s to 6 s.
  writeHeldContact([](double time) { return time >= 3.0 && time < 6.0; });
  ASSERT_EQ(run(check("held.bag", "made")).exit_code, kDone);
  std::map<std::string, int> verdicts;
  int delayed = 0;
  for (Row cycle : table("made/cycles.csv")) {
    ++verdicts[cycle["verdict"]];
    delayed += std::stoi(cycle["delayed"]) > 0;
    if (std::stoi(cycle["delayed"]) > 0) {
      EXPECT_NE(cycle["reason"].find("pairs wait for transforms"), std::string::npos) << cycle["reason"];
    }
  }
  EXPECT_EQ(verdicts["CLEAR"], 0);
  EXPECT_GT(verdicts["CONTACT"], 130);
  EXPECT_GT(verdicts["NOT_CHECKED"], 80);
  EXPECT_GT(delayed, 10);
}

TEST_F(CheckBag, SilenceOfAllIsSaidInTheBagAndNoCycle) {
  writeHeldContact([](double) { return false; }, 4.0, 6.0);
  const ToolRun result = run(check("held.bag", "made"));
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  const std::vector<Row> cycles = table("made/cycles.csv");
  int silent = 0, not_checked = 0;
  rosbag::Bag bag(path("made/checked.bag").string());
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    if (const auto state = message.instantiate<MonitorState>()) {
      not_checked += state->verdict == MonitorState::NOT_CHECKED && state->reason == "no new transforms";
    }
    const auto contacts = message.instantiate<ContactArray>();
    if (!contacts || contacts->cycle_start != contacts->header.stamp) continue;
    ++silent;
    EXPECT_EQ(contacts->verdict, ContactArray::NOT_CHECKED);
    EXPECT_EQ(contacts->reason, "no new transforms");
    EXPECT_TRUE(contacts->pairs.empty());
    EXPECT_NEAR(contacts->header.stamp.toSec(), kBegin + 4.0, 2.0 * kPeriod);
    EXPECT_GT(message.getTime().toSec(), kBegin + 4.5);
    EXPECT_LT(message.getTime().toSec(), kBegin + 4.6);
  }
  EXPECT_EQ(silent, 1);
  EXPECT_EQ(not_checked, 1);
  // The cycle that ends the silence tells of it.
  EXPECT_EQ(std::count_if(cycles.begin(), cycles.end(), [](Row cycle) { return cycle["verdict"] == "NOT_CHECKED"; }),
            1);
}

TEST_F(CheckBag, TransformsThatComeLateAreNamed) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  {
    rosbag::Bag bag(path("made/checked.bag").string(), rosbag::bagmode::Append);
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    geometry_msgs::TransformStamped& transform = message.transforms[0];
    transform.header.frame_id = "base";
    transform.child_frame_id = "turret";
    transform.header.stamp = ros::Time(kBegin + 10.5 * kPeriod);
    transform.transform.rotation.z = 1.0;  // far from where it was
    bag.write("/tf", ros::Time(kBegin + 13.2 * kPeriod), message);
  }
  const ToolRun result = run(check("made/checked.bag", "again"));
  EXPECT_NE(result.out.find("late transforms  in 1 cycles"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("frames: turret"), std::string::npos) << result.out;
  int contradicting = 0;
  for (Row cycle : table("again/cycles.csv")) {
    if (cycle["contradicted_since"] == "0.000000000") continue;
    ++contradicting;
    EXPECT_NEAR(std::stod(cycle["contradicted_since"]), kBegin + 10.0 * kPeriod, 1e-6);
  }
  EXPECT_EQ(contradicting, 1);
}

TEST_F(CheckBag, StartAndDurationChooseAPart) {
  ASSERT_EQ(run(check("arm.bag", "part", "--start 0.1 --duration 0.4")).exit_code, kDone);
  const std::vector<Row> cycles = table("part/cycles.csv");
  ASSERT_FALSE(cycles.empty());
  EXPECT_NEAR(std::stod(Row(cycles.front())["t0"]), kBegin + 0.1, 2.0 * kPeriod);
  EXPECT_NEAR(std::stod(Row(cycles.back())["t1"]), kBegin + 0.5, 2.0 * kPeriod);
  EXPECT_TRUE(table("part/contacts.csv").empty());
}

TEST_F(CheckBag, BadBagsAreRefused) {
  const std::string bytes = readText(path("arm.bag"));
  write("cut.bag", bytes.substr(0, bytes.size() / 2));
  write("empty.bag", "");
  write("text.bag", "not a bag");
  rosbag::Bag(path("none.bag").string(), rosbag::bagmode::Write).close();
  const std::map<std::string, std::string> reasons = {{"cut.bag", "try `rosbag reindex cut.bag`"},
                                                      {"empty.bag", ": is not a bag"},
                                                      {"text.bag", ": is not a bag"},
                                                      {"none.bag", "none.bag"},
                                                      {"missing.bag", ": cannot be opened: No such file"},
                                                      {".", ": is a directory, not a bag"}};
  for (const auto& [bag, reason] : reasons) {
    expectRefused(check(bag, "no"), reason);
    expectRefused("plot-bag " + bag + " --out no", reason);
  }
  expectRefused("plot-bag arm.bag --out no", "holds no sdf_ccd/ContactArray");
  expectRefused(check("arm.bag", "no", "--start 1000"), "nothing is left after the start at 1000 s");
  for (const char* option : {"--rate -1", "--max-error 0", "--threads -1", "--start nan", "--duration 0"}) {
    expectRefused(check("arm.bag", "no", option), std::string(option).substr(0, std::string(option).find(' ')));
  }
  write("bad.yaml", "rate: fast\n");
  expectRefused(check("arm.bag", "no", "--config bad.yaml"), "bad.yaml: parameter ~/rate is fast");
  write("bad.yaml", "filed: {cell_size: 0.01}\n");
  expectRefused(check("arm.bag", "no", "--config bad.yaml"),
                "bad.yaml: nothing reads parameter ~/filed, did you mean field?");
  write("bad.yaml", "world: [{name: ball, type: sphere, radius: 0.1, xzy: [1, 2, 3]}]\n");
  expectRefused(check("arm.bag", "no", "--config bad.yaml"),
                "bad.yaml: nothing reads parameter ~/world[0]/xzy, did you mean xyz?");
  write("bad.yaml", "rate: fast\n");
  expectRefused(check("arm.bag", "no", "--srdf missing.srdf"), "missing.srdf");
  expectRefused(check("arm.bag", "no", "--srdf bad.yaml"), "bad.yaml: the SRDF cannot be parsed: line 1");
  for (const char* text : {"arm", "<robot name='arm'><link name='a'/><link", "<robot name='arm'><joint/></robot>"}) {
    write("bad.urdf", text);
    expectRefused("check-bag arm.bag --urdf bad.urdf --out no", "bad.urdf: the URDF cannot be parsed: ");
  }
}

TEST_F(CheckBag, MaxErrorIsKeptByABodyOfSeveralElements) {
  const ToolRun result = run(check("arm.bag", "made", "--max-error 0.005"));
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_EQ(result.error.find("warning"), std::string::npos) << result.error;
  EXPECT_EQ(result.out.find("expected         about "), 0u) << result.out;
  EXPECT_NE(readText(path("made/plan.txt")).find("within the max_error of 5.00"), std::string::npos);
}

TEST_F(CheckBag, ABoundAboveMaxErrorIsAWarning) {
  write("ball.yaml", "world: [{name: dome, type: sphere, radius: 2.0, xyz: [2.5, 0, 0]}]\ncache_directory: cache\n");
  const ToolRun result = run("check-bag arm.bag --urdf " SDF_CCD_SOURCE_DIR
                             "/config/demo/arm.urdf --config ball.yaml --out made --max-error 0.005");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_EQ(result.error.find("sdf_ccd: warning: the error bound is "), 0u) << result.error;
  EXPECT_NE(result.error.find("more than the max_error of 5.00 mm: dome is only a field"), std::string::npos)
      << result.error;
}

TEST_F(CheckBag, WhatCannotBeMeantIsRefusedBeforeItIsBuilt) {
  expectRefused(check("arm.bag", "no", "--max-error 1e-6"), "a max_error of 1e-06 m would take about ");
  expectRefused(check("arm.bag", "no", "--max-error 1e-300"), "max_error must be at least 1e-09 m, not 1e-300 m");
  expectRefused(check("arm.bag", "no", "--max-error 1e9"), "a max_error of 1e+09 m is larger than every body: ");
  expectRefused(check("arm.bag", "no", "--rate 1e9"), "a rate of 1e+09 Hz is above the largest, 10000 Hz");
}

TEST_F(CheckBag, InterruptedItLeavesNothing) {
  write("fine.yaml", "cache: false\nfield: {cell_size: 0.0007}\n");
  const std::string script = "cd '" + path("").string() + "' && { '" SDF_CCD_TOOL "' " +
                             check("arm.bag", "no", "--config fine.yaml") +
                             " > /dev/null 2> ../error.txt & "
                             "for i in $(seq 300); do [ -d no ] && break; sleep 0.02; done; "
                             "kill -INT $!; wait $!; }";
  const int status = std::system(script.c_str());
  EXPECT_EQ(WEXITSTATUS(status), kBadInput);
  EXPECT_NE(readText(path("../error.txt")).find("interrupted: nothing is written to no"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("no")));
}

TEST_F(CheckBag, KilledItLeavesNoFiles) {
  {
    const int unnamed = ::open(path("").c_str(), O_TMPFILE | O_RDWR, 0600);
    if (unnamed < 0) GTEST_SKIP() << "this file system has no files without a name";
    ::close(unnamed);
  }
  write("fine.yaml", "cache: false\nfield: {cell_size: 0.0007}\n");
  const std::string script = "cd '" + path("").string() + "' && { '" SDF_CCD_TOOL "' " +
                             check("arm.bag", "no", "--config fine.yaml") +
                             " > /dev/null 2>&1 & "
                             "for i in $(seq 300); do [ -d no ] && break; sleep 0.02; done; sleep 0.1; "
                             "kill -KILL $!; wait $!; }";
  const int status = std::system((script + " 2> /dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGKILL);
  ASSERT_TRUE(fs::exists(path("no")));
  EXPECT_TRUE(fs::is_empty(path("no"))) << fs::directory_iterator(path("no"))->path();
}

TEST_F(CheckBag, OnAFullDiskItLeavesNothing) {
  write("arm.yaml", readText(path("arm.yaml")) + "cache: false\n");
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  const auto kilobytes = fs::file_size(path("made/checked.bag")) / 1024;
  const std::size_t files = countFiles();
  for (const std::string& limit : {std::to_string(kilobytes - 1), std::to_string(kilobytes / 2), std::string("1")}) {
    // A limit on the size of files: their writer is told as of a full disk, that no more can be written.
    const std::string script = "cd '" + path("").string() + "' && ulimit -f " + limit + " && trap '' XFSZ && '" +
                               SDF_CCD_TOOL "' " + check("arm.bag", "no") + " > /dev/null 2> ../error.txt";
    const int status = std::system(("bash -c \"" + script + "\"").c_str());
    const std::string error = test::withoutProgress(readText(path("../error.txt")));
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), kBadInput) << error;
    EXPECT_NE(error.find(": cannot write: File too large"), std::string::npos) << error;
    EXPECT_EQ(error.find('/'), 0u + std::string("sdf_ccd: no").size()) << error;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
    EXPECT_EQ(countFiles(), files);
    EXPECT_FALSE(fs::exists(path("no")));
  }
}

/// A base, two links on it that can touch, and others, whose transforms nobody sends.
std::string robotOfManyLinks(int others) {
  const std::string shape =
      "<collision><origin xyz='0 0.05 0'/><geometry><sphere radius='0.01'/></geometry></collision>";
  std::string urdf = "<robot name='many'><link name='base'>" + shape + "</link>";
  const auto add = [&](const std::string& name) {
    urdf += "<link name='" + name + "'>" + shape + "</link><joint name='to_" + name +
            "' type='continuous'><parent link='base'/><child link='" + name + "'/><origin xyz='0.05 0 0'/></joint>";
  };
  add("known");
  add("known2");
  for (int i = 0; i < others; ++i) add(std::string("lost_") + char('a' + i));
  return urdf + "</robot>";
}

TEST_F(CheckBag, WhyNothingWasCheckedIsSaidFirst) {
  write("many.urdf", robotOfManyLinks(16));
  write("many.yaml", "check_adjacent: true\ncache: false\n");
  const std::string options = " --urdf many.urdf --config many.yaml --out ";
  const auto writeTf = [&](const std::string& file, const std::map<std::string, std::string>& parents) {
    rosbag::Bag bag(path(file).string(), rosbag::bagmode::Write);
    tf2_msgs::TFMessage message;
    for (const auto& [child, parent] : parents) {
      message.transforms.emplace_back();
      message.transforms.back().header.frame_id = parent;
      message.transforms.back().child_frame_id = child;
      message.transforms.back().transform.translation.z = 0.2 * double(message.transforms.size());
    }
    for (auto& transform : message.transforms) transform.transform.rotation.w = 1.0;
    for (int i = 0; i < 60; ++i) {
      for (auto& transform : message.transforms) transform.header.stamp = ros::Time(kBegin + kPeriod * i);
      bag.write("/tf", message.transforms[0].header.stamp, message);
    }
  };
  // Links whose transforms do not come: one reason, of whatever many links.
  writeTf("some.bag", {{"known", "base"}, {"known2", "base"}});
  const ToolRun some = run("check-bag some.bag" + options + "some");
  EXPECT_EQ(some.exit_code, kPartlyDone) << some.error;
  EXPECT_EQ(
      some.error.find("sdf_ccd: no cycle was checked as a whole, as known - lost_a: no transform from lost_a to "), 0u)
      << some.error;
  const std::size_t not_checked = some.out.find("\nnot checked ");
  EXPECT_LT(not_checked, some.out.find("\ncontact "));
  EXPECT_EQ(some.out.find(" more\n", not_checked), std::string::npos) << some.out;
  EXPECT_NE(some.out.find("as known - lost_a: no transform from lost_a to base: none of lost_a has come", not_checked),
            std::string::npos)
      << some.out;

  // A fixed frame that the robot's transforms do not lead to.
  writeTf("apart.bag", {{"known", "base"},
                        {"known2", "base"},
                        {"lost_a", "base"},
                        {"lost_b", "base"},
                        {"lost_c", "base"},
                        {"odom", "world"}});
  write("many.urdf", robotOfManyLinks(3));
  write("many.yaml", "check_adjacent: true\ncache: false\nfixed_frame: world\n");
  expectRefused("check-bag apart.bag" + options + "no",
                "apart.bag: nothing could be checked, as known - known2: no transform from known to world: tf's tree "
                "is rooted at base, not world");
}

TEST_F(CheckBag, JointStatesThatAreNotFiniteAreCounted) {
  {
    rosbag::Bag bag(path("nan.bag").string(), rosbag::bagmode::Write);
    const Pose pose = downwards();
    for (int i = 0; i < 60; ++i) {
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(kBegin + kPeriod * i);
      state.name = {"yaw", "shoulder", "elbow", "wrist", "roll", "unknown"};
      const double nan = std::nan("");
      state.position = {kFirstYaw, pose.shoulder, nan, pose.wrist, 0.0, nan};
      bag.write("joint_states", state.header.stamp, state);
    }
  }
  const ToolRun result = run(check("nan.bag", "made"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("60 positions of joint elbow in joint_states are not finite"), std::string::npos)
      << result.error;
  EXPECT_EQ(result.error.find("unknown"), std::string::npos) << result.error;
}

TEST_F(CheckBag, JointsThatNoJointStateNamesAreNamed) {
  writeHeldContact([](double) { return true; });  // of the elbow
  const ToolRun result = run(check("held.bag", "made"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("joint_states names nowhere these joints of the robot: elbow\n"), std::string::npos)
      << result.error;
  const ToolRun complete = run(check("arm.bag", "whole"));
  EXPECT_EQ(complete.error.find("names nowhere"), std::string::npos) << complete.error;
}

TEST_F(CheckBag, PairsAreLearnedFromABag) {
  const std::string command = "learn-pairs --urdf " SDF_CCD_SOURCE_DIR "/config/demo/arm.urdf --max-error 0.02 ";
  // The arm only swings about, with its hand far from itself.
  const ToolRun swings = run(command + "--states 0 --bag arm.bag --out arm.srdf");
  ASSERT_EQ(swings.exit_code, kDone) << swings.error;
  EXPECT_NE(swings.out.find(", 5 recorded, and the default"), std::string::npos) << swings.out;  // different ones
  EXPECT_NE(readText(path("arm.srdf")).find("link1=\"turret\" link2=\"hand\" reason=\"Never\""), std::string::npos);
  EXPECT_NE(readText(path("arm.srdf")).find("it holds for what was recorded"), std::string::npos);
  expectRefused(command + "--states 0 --bag missing.bag --out no.srdf", "missing.bag: cannot be opened");
  expectRefused(command + "--states 0 --bag arm.bag --joint-states /else --out no.srdf",
                "arm.bag: holds no joint states of the robot's joints on /else");
}

TEST_F(CheckBag, ARobotThatTheBagIsNotAboutIsRefused) {
  const std::string link = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  write("other.urdf", "<robot name='other'><link name='a'>" + link + "</link><link name='b'>" + link +
                          "</link><joint name='ab' type='continuous'><parent link='a'/><child link='b'/><origin "
                          "xyz='1 0 0'/></joint></robot>");
  expectRefused("check-bag arm.bag --urdf other.urdf --out no", "neither tf nor joint_states is about the robot");
  write("map.yaml", "fixed_frame: map\n");
  expectRefused(check("arm.bag", "no", "--config map.yaml"), "the fixed frame map is neither in tf nor a link");
}

TEST_F(CheckBag, WhatCannotBeCheckedIsNamed) {
  ::setenv("ROS_PACKAGE_PATH", path("").c_str(), 1);
  const ToolRun result = run(check("arm.bag", "made"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("not checked: link hand: package://sdf_ccd/"), std::string::npos) << result.error;
  EXPECT_EQ(table("made/cycles.csv")[0]["verdict"], "NOT_CHECKED");
}

}  // namespace
}  // namespace sdf_ccd
