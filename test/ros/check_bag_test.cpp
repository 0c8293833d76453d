#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <set>

#include <rosbag/view.h>

#include "ros/check_bag_case.h"
#include "ros/messages/conversions.h"
#include "ros/tf_messages.h"
#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/DistanceArray.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd::check_bag_test {

using namespace test;

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
  const double enter = timeOfYaw(std::asin((kPlateY - kHalfPlate - kFinger) / kReach));
  const double leave = timeOfYaw(std::asin((kPlateY + kHalfPlate + kFinger) / kReach));
  EXPECT_NEAR(std::stod(contact["start"]), enter, 1e-3);
  EXPECT_NEAR(std::stod(contact["end"]), leave, 1e-3);
  EXPECT_EQ(contact["seen_at_samples"], "0");
  EXPECT_NEAR(std::stod(contact["depth"]), kFinger, 1e-3);  // the plate's middle is at the finger's axis
  EXPECT_NEAR(std::stod(contact["y"]), kPlateY, kHalfPlate + 1e-3);
  EXPECT_LT(std::stod(contact["error_bound"]), 1e-4);  // triangles decide
  const double of_contact = std::stod(contact["contact_error_bound"]);
  EXPECT_GE(of_contact, std::abs(std::stod(contact["depth"]) - kFinger));
  EXPECT_GT(of_contact, 0.001);
  EXPECT_LT(of_contact, 0.01);
}

/// A wheel that sinks into the base of its caster, and a lamp above.
TEST_F(CheckBag, PairsThatAreSetAsideAreSaidAtTheEnd) {
  const auto link = [](const std::string& name, const std::string& z, const std::string& shape) {
    return "<link name='" + name + "'><collision><origin xyz='0 0 " + z + "'/><geometry>" + shape +
           "</geometry></collision></link>";
  };
  const auto hinge = [](const std::string& parent, const std::string& child) {
    return "<joint name='to_" + child + "' type='continuous'><parent link='" + parent + "'/><child link='" + child +
           "'/></joint>";
  };
  write("cart.urdf", "<robot name='cart'>" + link("base", "0", "<box size='1 1 0.2'/>") +
                         link("caster", "-0.5", "<sphere radius='0.01'/>") +
                         link("wheel", "0", "<sphere radius='0.1'/>") + link("lamp", "2", "<sphere radius='0.1'/>") +
                         hinge("base", "caster") + hinge("caster", "wheel") + hinge("base", "lamp") + "</robot>");
  rosbag::Bag bag(path("cart.bag").string(), rosbag::bagmode::Write);
  for (int i = 0; i < 20; ++i) {
    sensor_msgs::JointState state;
    state.header.stamp = ros::Time(kBegin + kSamplePeriod * i);
    state.name = {"to_caster", "to_wheel", "to_lamp"};
    state.position = {0.01 * i, 0.02 * i, 0.0};
    bag.write("joint_states", state.header.stamp, state);
  }
  bag.close();
  // The lamp is checked against the ground, so that there is something to check.
  write("cart.yaml", "cache: false\nworld: [{name: ground, type: box, size: [4, 4, 0.1], xyz: [0, 0, -2]}]\n");
  const ToolRun result = run("check-bag cart.bag --urdf cart.urdf --config cart.yaml --out made");
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  const std::string told = "\n1 pair that overlaps at rest is set aside: base - wheel (";
  const std::size_t at = result.out.find(told);
  ASSERT_NE(at, std::string::npos) << result.out;
  EXPECT_GT(at, result.out.find("\nspeed "));
  EXPECT_NE(result.out.find("\n<disable_collisions link1=\"base\" link2=\"wheel\" reason=\"Default\"/>\n", at),
            std::string::npos)
      << result.out;
  EXPECT_EQ(readText(path("made/summary.txt")), result.out);
}

/// Results do not depend on the load of the machine, also if a configuration for a running monitor limits its time.
TEST_F(CheckBag, ALimitOfACyclesTimeChangesNothing) {
  write("limited.yaml", readText(path("arm.yaml")) + "max_cycle_time: 1.0e-6\n");
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  ASSERT_EQ(run(check("arm.bag", "limited", "--config limited.yaml")).exit_code, kDone);
  EXPECT_EQ(readText(path("made/contacts.csv")), readText(path("limited/contacts.csv")));
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
      EXPECT_GT(state->cycle.run_time, 0.0);
      EXPECT_GT(state->cycle.error_bound.total, 0.0);
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

/// The finger's side is at y = kReach sin(yaw) + its radius, in front of the plate at first, and behind it later.
TEST_F(CheckBag, MeasuresDistancesAsTheMonitorDoes) {
  const std::string world = readText(SDF_CCD_SOURCE_DIR "/config/demo/world.yaml");
  write("near.yaml", world +
                         "cache: false\nreport_distance: 0.2\nwarning_distance: 0.03\nstop_distance: 0.01\n"
                         "velocity_scale: {max_speed: 1.0}\n");
  const ToolRun result = run(check("arm.bag", "made", "--config near.yaml "));
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  std::size_t distances = 0, scales = 0, states = 0;
  std::set<int> levels;
  double first = 0.0;
  rosbag::Bag bag(path("made/checked.bag").string());
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    if (const auto near = message.instantiate<DistanceArray>()) {
      ++distances;
      EXPECT_EQ(near->range, 0.2);
      for (const Distance& pair : near->distances) {
        const bool is_hand = pair.body_a == "hand" || pair.body_b == "hand";
        const bool is_plate = pair.body_a == "plate" || pair.body_b == "plate";
        if (is_hand && is_plate && first == 0.0) first = pair.distance;
      }
    } else if (const auto state = message.instantiate<MonitorState>()) {
      ++states;
      levels.insert(state->proximity);
    } else if (const auto scale = message.instantiate<std_msgs::Float64>()) {
      ++scales;
      EXPECT_EQ(message.getTopic(), "/collision_monitor/velocity_scale");
      EXPECT_GE(scale->data, 0.0);
      EXPECT_LE(scale->data, 1.0);
    }
  }
  EXPECT_NEAR(first, kPlateY - kHalfPlate - kReach * std::sin(kFirstYaw) - kFinger, 1e-4);
  EXPECT_EQ(distances, table("made/cycles.csv").size());
  EXPECT_EQ(scales, states);
  EXPECT_EQ(levels, (std::set<int>{MonitorState::FREE, MonitorState::WARNING, MonitorState::STOP}));
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
  const std::string from_time = plot.out.substr(plot.out.find("time   ")),
                    time_line = from_time.substr(0, from_time.find('\n'));
  EXPECT_NE(readText(path("made/summary.txt")).find(time_line), std::string::npos)
      << "both count from the bag's beginning: " << plot.out;
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

/// A monitor's message about one contact, as known until `end`.
ContactArray toldOf(std::uint64_t id, bool begins, double begin, double end) {
  ContactArray message;
  message.cycle.start = ros::Time(end - 0.1);
  message.header.stamp = message.cycle.complete_until = ros::Time(end);
  message.verdict = numberOf(Verdict::kContact);
  message.cycle.checked = 1;
  message.cycle.error_bound.total = 0.001;
  message.contacts.resize(1);
  Contact& contact = message.contacts[0];
  contact.id = id;
  contact.begins = begins;
  contact.body_a = "a";
  contact.body_b = "b";
  contact.verdict = numberOf(Verdict::kContact);
  contact.begin = ros::Time(begin);
  contact.end = ros::Time(end);
  return message;
}

TEST_F(CheckBag, TheTableHasARowPerContactAsTheLastMessageHasIt) {
  {
    rosbag::Bag bag(path("told.bag").string(), rosbag::bagmode::Write);
    // A contact, another one, and one of a monitor that was restarted.
    for (const ContactArray& message :
         {toldOf(1, true, kBegin, kBegin + 0.1), toldOf(1, false, kBegin, kBegin + 0.2),
          toldOf(2, true, kBegin + 0.5, kBegin + 0.6), toldOf(1, true, kBegin + 0.8, kBegin + 0.9)}) {
      bag.write("contacts", message.header.stamp, message);
    }
  }
  const ToolRun result = run("plot-bag told.bag --out told");
  EXPECT_LE(result.exit_code, kPartlyDone) << result.error;
  std::string rows;
  for (Row contact : table("told/contacts.csv")) {
    rows += contact["id"] + " " + contact["verdict"] + " " +
            std::to_string(std::lround(10.0 * (std::stod(contact["end"]) - kBegin))) + "; ";
  }
  EXPECT_EQ(rows, "1 CONTACT 2; 2 CONTACT 6; 1 CONTACT 9; ");
}

/// Tests the last row of cycles.csv, which is about a gap, not a cycle.
void expectGap(const std::vector<Row>& cycles, double from, double until) {
  Row last = cycles.back(), before = cycles.at(cycles.size() - 2);
  EXPECT_EQ(last["verdict"], "NOT_CHECKED");
  EXPECT_EQ(last["reason"], "no new transforms");
  EXPECT_EQ(last["t0"], before["t1"]);
  EXPECT_NEAR(std::stod(last["t0"]), from, 2.0 * kSamplePeriod);
  EXPECT_NEAR(std::stod(last["t1"]), until, 2.0 * kSamplePeriod);
  EXPECT_GT(std::stoi(last["not_checked"]), 0);
  EXPECT_EQ(last["checked"] + last["skipped"], "00");
}

TEST_F(CheckBag, WhatComesAfterTheLastTransformsIsNotChecked) {
  rosbag::Bag(path("arm.bag").string(), rosbag::bagmode::Append)
      .write("other", ros::Time(kBegin + 4.0), tf2_msgs::TFMessage());
  const ToolRun result = run(check("arm.bag", "made"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("sdf_ccd: nothing was checked from 1.428 s to "), std::string::npos) << result.error;
  EXPECT_NE(result.out.find("\nno cycle         for 2.5"), std::string::npos) << result.out;
  const std::vector<Row> cycles = table("made/cycles.csv");
  expectGap(cycles, kBegin + kSamplePeriod * (kBefore + 3 + kAfter), kBegin + 4.0);

  // It is in the bag, too, and is not counted as a cycle.
  EXPECT_NE(result.out.find("\ncycles           " + std::to_string(cycles.size() - 1) + ":"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find(" CLEAR, 0 NOT_CHECKED,"), std::string::npos) << result.out;
  EXPECT_LE(run("plot-bag made/checked.bag --out plot").exit_code, kPartlyDone);
  EXPECT_EQ(readText(path("plot/cycles.csv")), readText(path("made/cycles.csv")));
}

TEST_F(CheckBag, TransformsThatAreRefusedAreSaid) {
  {
    rosbag::Bag bag(path("ahead.bag").string(), rosbag::bagmode::Write);
    const Pose pose = downwards();
    for (int i = 0; i < 90; ++i) {
      sensor_msgs::JointState state;
      const ros::Time time(kBegin + kSamplePeriod * i);
      state.header.stamp = i < 45 ? time : time + ros::Duration(30.0);
      state.name = {"yaw", "shoulder", "elbow", "wrist", "roll"};
      state.position = {kFirstYaw, pose.shoulder, pose.elbow, pose.wrist, 0.0};
      bag.write("joint_states", time, state);
    }
  }
  const ToolRun result = run(check("ahead.bag", "made"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("sdf_ccd: warning: 225 transforms were refused, the last as "), std::string::npos)
      << result.error;
  EXPECT_NE(result.error.find(" is stamped 132.967 s, when it is 10"), std::string::npos) << result.error;
  EXPECT_NE(readText(path("made/plan.txt")).find("225 transforms were refused"), std::string::npos);
  expectGap(table("made/cycles.csv"), kBegin + 1.5, kBegin + 3.0);
}

TEST_F(CheckBag, TimeThatJumpsBackBeginsAnew) {
  writeJointStates(10.0);
  const ToolRun result = run(check("arm.bag", "made"));
  ASSERT_EQ(result.exit_code, kPartlyDone) << result.error;
  EXPECT_NE(result.error.find("sdf_ccd: nothing was checked from 1.4"), std::string::npos) << result.error;
  const std::vector<Row> contacts = table("made/contacts.csv");
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(Row(contacts[0])["start"], Row(contacts[1])["start"]);
  EXPECT_NE(readText(path("made/summary.txt")).find("time jumped back and the monitor was reset\n  from 1.4"),
            std::string::npos);
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
  // The finger is in the plate all the time; the elbow's position is missing from 3 s to 6 s.
  writeHeldContact([](double time) { return time >= 3.0 && time < 6.0; });
  ASSERT_EQ(run(check("held.bag", "made")).exit_code, kPartlyDone);
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

TEST_F(CheckBag, PairsWhoseBodiesAreNeverKnownAtOnceAreNotComplete) {
  // The elbow, and with it the hand, says nothing from 3 s on; an object comes after that. All else is checked.
  writeHeldContact([](double time) { return time >= 3.0; });
  {
    rosbag::Bag bag(path("held.bag").string(), rosbag::bagmode::Append);
    for (double time = kBegin + 5.0; time < kBegin + 8.0; time += kSamplePeriod)
      bag.write("/tf", ros::Time(time), message({stampedTransform("base", "late", time, 5.0)}));
  }
  const std::string world = readText(SDF_CCD_SOURCE_DIR "/config/demo/world.yaml");
  write("late.yaml", world +
                         "  - {name: late, frame: late, type: sphere, radius: 0.05}\n"
                         "cache: false\nfield: {cell_size: 0.006}\nshell: {spacing: 0.003}\n");
  const ToolRun result = run(check("held.bag", "made", "--config late.yaml"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find(" pairs were never checked, for example "), std::string::npos) << result.error;
}

TEST_F(CheckBag, SilenceOfAllIsSaidInTheBagAndNoCycle) {
  writeHeldContact([](double) { return false; }, 4.0, 6.0);
  const ToolRun result = run(check("held.bag", "made"));
  ASSERT_EQ(result.exit_code, kPartlyDone) << result.error;
  EXPECT_NE(result.error.find(" for 2.00 of 7.97 s"), std::string::npos) << result.error;
  const std::vector<Row> cycles = table("made/cycles.csv");
  int silent = 0, not_checked = 0;
  rosbag::Bag bag(path("made/checked.bag").string());
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    if (const auto state = message.instantiate<MonitorState>()) {
      not_checked += state->verdict == numberOf(Verdict::kNotChecked) && state->reason == "no new transforms";
    }
    const auto contacts = message.instantiate<ContactArray>();
    if (!contacts || contacts->cycle.start != contacts->header.stamp) continue;
    ++silent;
    EXPECT_EQ(contacts->verdict, numberOf(Verdict::kNotChecked));
    EXPECT_EQ(contacts->reason, "no new transforms");
    EXPECT_TRUE(contacts->pairs.empty());
    EXPECT_NEAR(contacts->header.stamp.toSec(), kBegin + 4.0, 2.0 * kSamplePeriod);
    EXPECT_GT(message.getTime().toSec(), kBegin + 4.5);
    EXPECT_LT(message.getTime().toSec(), kBegin + 4.6);
  }
  EXPECT_EQ(silent, 1);
  EXPECT_EQ(not_checked, 1);
  // The cycle that ends the gap reports it.
  EXPECT_EQ(std::count_if(cycles.begin(), cycles.end(), [](Row cycle) { return cycle["verdict"] == "NOT_CHECKED"; }),
            1);
}

TEST_F(CheckBag, StartAndDurationChooseAPart) {
  ASSERT_EQ(run(check("arm.bag", "part", "--start 0.1 --duration 0.4")).exit_code, kDone);
  const std::vector<Row> cycles = table("part/cycles.csv");
  ASSERT_FALSE(cycles.empty());
  EXPECT_NEAR(std::stod(Row(cycles.front())["t0"]), kBegin + 0.1, 2.0 * kSamplePeriod);
  EXPECT_NEAR(std::stod(Row(cycles.back())["t1"]), kBegin + 0.5, 2.0 * kSamplePeriod);
  EXPECT_TRUE(table("part/contacts.csv").empty());
  // All times count from the bag's beginning, as --start does.
  const std::string summary = readText(path("part/summary.txt"));
  const std::size_t time = summary.find("time             from ");
  ASSERT_NE(time, std::string::npos) << summary;
  EXPECT_NEAR(std::stod(summary.substr(time + 22)), 0.1, 2.0 * kSamplePeriod) << summary;
}

TEST_F(CheckBag, MaxErrorIsKeptByABodyOfSeveralElements) {
  const ToolRun result = run(check("arm.bag", "made", "--max-error 0.005"));
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_EQ(result.error.find("warning"), std::string::npos) << result.error;
  EXPECT_NE(readText(path("made/plan.txt")).find("within the max_error of 5.00"), std::string::npos);
}

TEST_F(CheckBag, ABoundAboveMaxErrorIsAWarning) {
  write("silo.yaml",  // the ground, so large that its triangles deviate by 40 um
        "world: [{name: silo, type: cylinder, radius: 100.0, length: 2.0, xyz: [0, 0, -1.2]}]\n"
        "cache_directory: cache\n");
  const ToolRun result = run("check-bag arm.bag --urdf " SDF_CCD_SOURCE_DIR
                             "/config/demo/arm.urdf --config silo.yaml --out made --max-error 1e-5");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_EQ(result.error.find("sdf_ccd: warning: the error bound is "), 0u) << result.error;
  EXPECT_NE(result.error.find("more than the max_error of 0.01 mm: "), std::string::npos) << result.error;
}

TEST_F(CheckBag, PairsAreLearnedFromABag) {
  const std::string command = "learn-pairs --urdf " SDF_CCD_SOURCE_DIR "/config/demo/arm.urdf --max-error 0.02 ";
  // The arm only swings, with its hand far from its other links.
  const ToolRun swings = run(command + "--states 0 --bag arm.bag --out arm.srdf");
  ASSERT_EQ(swings.exit_code, kDone) << swings.error;
  EXPECT_NE(swings.out.find(", 5 recorded, and the default"), std::string::npos) << swings.out;  // 5 different ones
  EXPECT_NE(readText(path("arm.srdf")).find("link1=\"turret\" link2=\"hand\" reason=\"Never\""), std::string::npos);
  EXPECT_NE(readText(path("arm.srdf")).find("it holds for what was recorded"), std::string::npos);
  expectRefused(command + "--states 0 --bag missing.bag --out no.srdf", "missing.bag: cannot be opened");
  expectRefused(command + "--states 0 --bag arm.bag --joint-states /else --out no.srdf",
                "arm.bag: contains no joint states of the robot's joints on /else");
  sensor_msgs::JointState broken;
  broken.name = {"yaw", "shoulder", "unknown"};
  broken.position = {0.3, std::nan(""), std::nan("")};
  const auto write = [&](const char* bag, rosbag::bagmode::BagMode mode) {
    rosbag::Bag(path(bag).string(), mode).write("joint_states", ros::Time(1.0), broken);
  };
  write("broken.bag", rosbag::bagmode::Write);
  expectRefused(command + "--states 0 --bag broken.bag --out no.srdf",
                "only 1 joint states with positions that are not finite");
  write("arm.bag", rosbag::bagmode::Append);
  const ToolRun warned = run(command + "--states 0 --bag arm.bag --out arm.srdf");
  EXPECT_NE(warned.out.find(", 5 recorded, and the default"), std::string::npos) << warned.out;
  EXPECT_NE(warned.error.find("1 joint states with positions that are not finite are left out"), std::string::npos)
      << warned.error;
}

}  // namespace sdf_ccd::check_bag_test
