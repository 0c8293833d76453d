#include <fcntl.h>
#include <sys/stat.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>

#include <rosbag/view.h>

#include "ros/check_bag_case.h"
#include "ros/messages/conversions.h"
#include "ros/tf_messages.h"
#include "sdf_ccd/ContactArray.h"

namespace sdf_ccd::check_bag_ends_test {

using namespace test;

namespace fs = std::filesystem;

constexpr const char* kFine = "cache: false\nfield: {cell_size: 0.0007}\n";  // takes long to build

/// The bytes of a bag with one number of 32 bits set to another value.
std::string withNumber(std::string bytes, std::size_t at, std::uint32_t value) {
  bytes.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

/// One time in the index that was hours too early once kept the tool busy for half a minute.
TEST_F(CheckBag, DamagedBagsAreRefusedAtOnce) {
  const std::string bytes = readText(path("arm.bag")), op = "op=";
  const std::size_t index = bytes.find(op + '\4'), first = bytes.find("ver=", index) + 12;  // behind the data's length
  ASSERT_NE(index, std::string::npos);
  write("early.bag", withNumber(bytes, first, 1));
  write("outside.bag", withNumber(bytes, first + 8, 1u << 30));
  const std::size_t message = bytes.find(op + '\2'), length = bytes.find("time=", message) + 13;
  write("long.bag", withNumber(bytes, length, 3'875'537'342u));
  const std::map<std::string, std::string> reasons = {
      {"early.bag", "is cut short or damaged: the index has messages at times that their chunk"},
      {"outside.bag", "is an index of what its chunk does not hold"},
      {"long.bag", "a message on joint_states is longer than its chunk"}};
  for (const auto& [bag, reason] : reasons) {
    const auto start = std::chrono::steady_clock::now();
    expectRefused(check(bag, "no"), reason);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10.0) << bag;
  }
  ASSERT_EQ(::mkfifo(path("pipe.bag").c_str(), 0600), 0);
  expectRefused(check("pipe.bag", "no"), "pipe.bag: is not a regular file");
}

TEST_F(CheckBag, PosesThatAreMinutesApartNameMaxCycleAndTheServiceForThem) {
  rosbag::Bag bag(path("poses.bag").string(), rosbag::bagmode::Write);
  const Pose pose = downwards();
  for (int i = 0; i < 3; ++i) {
    sensor_msgs::JointState state;  // its stamp is 0
    state.name = {"yaw", "shoulder", "elbow", "wrist", "roll"};
    state.position = {0.1 * i, pose.shoulder, pose.elbow, pose.wrist, 0.0};
    bag.write("joint_states", ros::Time(kBegin + 120.0 * i), state);
  }
  bag.close();
  const ToolRun result = run(check("poses.bag", "made"));
  EXPECT_NE(result.exit_code, kDone);
  EXPECT_NE(result.error.find("up to 120 s apart, and what is longer than max_cycle (1 s) is no motion"),
            std::string::npos)
      << result.error;
  EXPECT_NE(result.error.find("query_motions"), std::string::npos) << result.error;
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
  expectRefused("plot-bag arm.bag --out no", "contains no sdf_ccd/ContactArray");
  expectRefused(check("arm.bag", "no", "--start 1000"), "nothing is left after the start at 1000 s");
  for (const char* option : {"--rate -1", "--max-error 0", "--threads -1", "--start nan", "--duration 0"}) {
    expectRefused(check("arm.bag", "no", option), std::string(option).substr(0, std::string(option).find(' ')));
  }
  write("bad.yaml", "rate: fast\n");
  expectRefused(check("arm.bag", "no", "--config bad.yaml"), "bad.yaml: line 1: parameter ~/rate is fast");
  write("bad.yaml", "filed: {cell_size: 0.01}\n");
  expectRefused(check("arm.bag", "no", "--config bad.yaml"),
                "bad.yaml: unknown parameter ~/filed, did you mean field?");
  write("bad.yaml", "world: [{name: ball, type: sphere, radius: 0.1, xzy: [1, 2, 3]}]\n");
  expectRefused(check("arm.bag", "no", "--config bad.yaml"),
                "bad.yaml: line 1: unknown parameter ~/world[0]/xzy, did you mean xyz?");
  write("bad.yaml", "rate: fast\n");
  expectRefused(check("arm.bag", "no", "--srdf missing.srdf"), "missing.srdf");
  expectRefused(check("arm.bag", "no", "--srdf bad.yaml"), "bad.yaml: the SRDF cannot be parsed: line 1");
  for (const char* text : {"arm", "<robot name='arm'><link name='a'/><link", "<robot name='arm'><joint/></robot>"}) {
    write("bad.urdf", text);
    expectRefused("check-bag arm.bag --urdf bad.urdf --out no", "bad.urdf: the URDF cannot be parsed: ");
  }
}

TEST_F(CheckBag, ADamagedNumberOfTransformsIsNamed) {
  const tf2_msgs::TFMessage message = test::message({stampedTransform("turret", "yaw_link", kBegin, 1.0)});
  rosbag::Bag(path("count.bag").string(), rosbag::bagmode::Write).write("/tf", ros::Time(kBegin), message);
  std::string bytes = readText(path("count.bag"));
  const std::uint32_t length = ros::serialization::serializationLength(message);
  std::string data(length, '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(&data[0]), length);
  ros::serialization::serialize(stream, message);
  const std::size_t place = bytes.find(data);
  ASSERT_NE(place, std::string::npos);
  for (const std::string count : {"\xff\xff\xff\xff", "\x40\x42\x0f\x01"}) {  // 16 million: a few GB
    bytes.replace(place, 4, count);
    write("count.bag", bytes);
    expectRefused(check("count.bag", "no"),
                  "count.bag: is cut short or damaged: a message on /tf has more elements than");
  }
}

TEST_F(CheckBag, TransformsOnOtherTopicsAreNamed) {
  rosbag::Bag bag(path("other.bag").string(), rosbag::bagmode::Write);
  bag.write("/arm/tf", ros::Time(kBegin), message({stampedTransform("base", "turret", kBegin, 1.0)}));
  bag.close();
  expectRefused(check("other.bag", "no"), "holds neither tf nor joint states; its transforms are on /arm/tf, and only");
}

TEST_F(CheckBag, AMessageThatHoldsNoVerdictIsRefused) {
  ContactArray message;
  message.cycle.start = ros::Time(kBegin);
  message.header.stamp = ros::Time(kBegin + 1.0);
  const auto write = [&](const char* name) {
    rosbag::Bag(path(name).string(), rosbag::bagmode::Write).write("/contacts", ros::Time(kBegin + 1.0), message);
  };
  message.verdict = 7;
  write("seven.bag");
  expectRefused("plot-bag seven.bag --out no", "a message about contacts is damaged: verdict 7");
  message.verdict = numberOf(Verdict::kClear);
  message.cycle.error_bound.total = std::nan("");
  write("nan.bag");
  expectRefused("plot-bag nan.bag --out no", "error bound nan");
}

/// As recorded by another version. What check-bag reads has not changed: such a bag can still be checked.
TEST_F(CheckBag, ABagOfMessagesOfAnotherDefinitionIsNamed) {
  const auto header = [](const std::string& type) {
    return boost::make_shared<ros::M_string>(ros::M_string{
        {"type", type}, {"md5sum", "0123456789abcdef0123456789abcdef"}, {"message_definition", "uint8 verdict"}});
  };
  const auto writeTo = [&](const std::string& bag, const std::string& topic, const std::string& type) {
    rosbag::Bag(path(bag).string(), rosbag::bagmode::Append)
        .write(topic, ros::Time(kBegin), ContactArray(), header(type));
  };
  std::filesystem::copy_file(path("arm.bag"), path("old.bag"));
  writeTo("old.bag", "/collision_monitor/contacts", "sdf_ccd/ContactArray");
  expectRefused("plot-bag old.bag --out no",
                "old.bag: /collision_monitor/contacts holds sdf_ccd/ContactArray of another definition, "
                "0123456789abcdef0123456789abcdef instead of " +
                    std::string(ros::message_traits::md5sum<ContactArray>()) +
                    ": it was recorded with another version of sdf_ccd: plot it with that one, or make new contacts");
  EXPECT_LE(run(check("old.bag", "checked")).exit_code, kPartlyDone);
  writeTo("old.bag", "/tf", "tf2_msgs/TFMessage");
  expectRefused(check("old.bag", "no"), "old.bag: /tf holds tf2_msgs/TFMessage of another definition");
}

TEST_F(CheckBag, ABagThatLastsLongerThanADurationIsNamed) {
  writeJointStates(2147483647.0);
  expectRefused(check("arm.bag", "no"),
                "arm.bag: lasts 2.14748e+09 s, longer than ROS can tell times apart: 2147483647");
}

TEST_F(CheckBag, WhatCannotBeMeantIsRefusedBeforeItIsBuilt) {
  for (const char* error : {"1e-6", "1e-300", "0.02", "1e9"})
    expectRefused(check("arm.bag", "no", std::string("--max-error ") + error), "expected from 1e-05 to 0.01 m");
  write("fine.yaml", "contact: {accuracy: 1.0e-6}\ncache: false\n");
  expectRefused(check("arm.bag", "no", "--config fine.yaml"), "a point every 1e-06 m on ");
  expectRefused(check("arm.bag", "no", "--rate 1e9"), "a rate of 1e+09 Hz is above the largest, 10000 Hz");
}

/// Sends the tool a signal while it builds. @return its exit status.
/// @param what  a command line that takes long to build.
int statusAfter(const std::string& signal, const std::string& folder, const std::string& what) {
  const std::string script = "cd '" + folder + "' && { '" SDF_CCD_TOOL "' " + what +
                             " > /dev/null 2> ../error.txt & "
                             "for i in $(seq 300); do [ -d no ] && break; sleep 0.02; done; sleep 0.1; "
                             "kill -" +
                             signal + " $!; wait $!; } 2> /dev/null";
  return WEXITSTATUS(std::system(script.c_str()));
}

TEST_F(CheckBag, InterruptedItLeavesNothing) {
  write("fine.yaml", kFine);
  EXPECT_EQ(statusAfter("INT", path("").string(), check("arm.bag", "no", "--config fine.yaml")), kBadInput);
  EXPECT_NE(readText(path("../error.txt")).find("interrupted: nothing is written to no"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("no")));
}

TEST_F(CheckBag, KilledItLeavesNoFiles) {
  {
    const int unnamed = ::open(path("").c_str(), O_TMPFILE | O_RDWR, 0600);
    if (unnamed < 0) GTEST_SKIP() << "this file system has no files without a name";
    ::close(unnamed);
  }
  write("fine.yaml", kFine);
  EXPECT_EQ(statusAfter("KILL", path("").string(), check("arm.bag", "no", "--config fine.yaml")), 128 + SIGKILL);
  ASSERT_TRUE(fs::exists(path("no")));
  EXPECT_TRUE(fs::is_empty(path("no"))) << fs::directory_iterator(path("no"))->path();
}

TEST_F(CheckBag, OnAFullDiskItLeavesNothing) {
  write("arm.yaml", readText(path("arm.yaml")) + "cache: false\n");
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  const auto kilobytes = fs::file_size(path("made/checked.bag")) / 1024;
  const std::size_t files = countFiles();
  for (const std::string& limit : {std::to_string(kilobytes - 1), std::to_string(kilobytes / 2), std::string("1")}) {
    // A limit on the size of files: for a writer this is like a full disk.
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

/// A base, two links on it that can touch, and other links whose transforms are never sent.
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
  write("many.yaml", "check_adjacent: true\ncache: false\noverlapping_pairs: leave_out\n");
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
      for (auto& transform : message.transforms) transform.header.stamp = ros::Time(kBegin + kSamplePeriod * i);
      bag.write("/tf", message.transforms[0].header.stamp, message);
    }
  };
  // Links without transforms: one reason for all of them.
  writeTf("some.bag", {{"known", "base"}, {"known2", "base"}});
  const ToolRun some = run("check-bag some.bag" + options + "some");
  EXPECT_EQ(some.exit_code, kPartlyDone) << some.error;
  EXPECT_EQ(some.error.find("sdf_ccd: no cycle was checked as a whole, as lost_a: no transform from lost_a to "), 0u)
      << some.error;
  EXPECT_NE(some.error.find("sdf_ccd: 168 pairs were never checked, for example "), std::string::npos) << some.error;
  const std::size_t not_checked = some.out.find("\nnot checked ");
  EXPECT_LT(not_checked, some.out.find("\ncontact "));
  EXPECT_EQ(some.out.substr(0, some.out.find("\nspeed ")).find(" more\n", not_checked), std::string::npos) << some.out;
  EXPECT_NE(
      some.out.find("as lost_a: no transform from lost_a to base: no transform of lost_a was received", not_checked),
      std::string::npos)
      << some.out;

  // A fixed frame that is not connected to the robot's transforms.
  writeTf("apart.bag", {{"known", "base"},
                        {"known2", "base"},
                        {"lost_a", "base"},
                        {"lost_b", "base"},
                        {"lost_c", "base"},
                        {"odom", "world"}});
  write("many.urdf", robotOfManyLinks(3));
  write("many.yaml", "check_adjacent: true\ncache: false\nfixed_frame: world\noverlapping_pairs: leave_out\n");
  expectRefused("check-bag apart.bag" + options + "no",
                "apart.bag: nothing could be checked, as known: no transform from known to world: tf's tree "
                "is rooted at base, not world");
}

TEST_F(CheckBag, JointStatesThatAreNotFiniteAreCounted) {
  {
    rosbag::Bag bag(path("nan.bag").string(), rosbag::bagmode::Write);
    const Pose pose = downwards();
    for (int i = 0; i < 60; ++i) {
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(kBegin + kSamplePeriod * i);
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

TEST_F(CheckBag, JointStatesThatLackPositionsAreCounted) {
  {
    rosbag::Bag bag(path("short.bag").string(), rosbag::bagmode::Write);
    const Pose pose = downwards();
    for (int i = 0; i < 60; ++i) {
      sensor_msgs::JointState state;
      state.header.stamp = ros::Time(kBegin + kSamplePeriod * i);
      state.name = {"yaw", "shoulder", "elbow", "wrist", "roll"};
      state.position = {kFirstYaw, pose.shoulder, pose.elbow, pose.wrist, 0.0};
      if (i % 2 == 1) state.position.pop_back();
      bag.write("joint_states", state.header.stamp, state);
      state.position.clear();  // as sent by publishers of velocities
      bag.write("joint_states", state.header.stamp, state);
    }
  }
  const ToolRun result = run(check("short.bag", "made"));
  EXPECT_EQ(result.exit_code, kDone);
  EXPECT_NE(result.error.find("sdf_ccd: warning: 30 messages of joint_states do not give a position per name\n"),
            std::string::npos)
      << result.error;
  // The links beyond wait for transforms, which is why cycles are NOT_CHECKED.
  const std::size_t reasons = result.out.find("\nNOT_CHECKED as\n  ");
  ASSERT_NE(reasons, std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" pairs wait for transforms, for up to ", reasons), std::string::npos) << result.out;
}

/// A plate that is fixed in the URDF, but that tf moves for a second: its pair with the base is added to the results
/// while it is so.
TEST_F(CheckBag, JoinedLinksThatTfMovesAreNoPairsOfThePlan) {
  const std::string box = "<collision><geometry><box size='0.02 0.02 0.02'/></geometry></collision>";
  const auto joint = [](const std::string& child, const std::string& type, const std::string& y) {
    return "<joint name='to_" + child + "' type='" + type + "'><parent link='base'/><child link='" + child +
           "'/><origin xyz='0.1 " + y + " 0'/><axis xyz='1 0 0'/></joint>";
  };
  write("plate.urdf", "<robot name='r'><link name='base'>" + box + "</link><link name='plate'>" + box +
                          "</link><link name='turn'>" + box + "</link>" + joint("plate", "fixed", "0") +
                          joint("turn", "continuous", "1") + "</robot>");
  {
    rosbag::Bag bag(path("moved.bag").string(), rosbag::bagmode::Write);
    for (int i = 0; i < 90; ++i) {
      const double time = kBegin + kSamplePeriod * i;
      geometry_msgs::TransformStamped turn = stampedTransform("base", "turn", time, 0.1);
      turn.transform.translation.y = 1.0;
      const bool is_moved = 30 <= i && i < 60;
      bag.write("/tf", ros::Time(time), message({stampedTransform("base", "plate", time, is_moved ? 0.2 : 0.1), turn}));
    }
  }
  write("plain.yaml", "cache: false\n");
  const ToolRun result = run("check-bag moved.bag --urdf plate.urdf --config plain.yaml --out made");
  EXPECT_EQ(result.exit_code, kPartlyDone) << result.error;
  EXPECT_NE(result.error.find("1 pair was left out, but may touch for a part of the time, base - plate for "),
            std::string::npos)
      << result.error;
  EXPECT_NE(readText(path("made/summary.txt")).find("31 cycles, as base - plate: rigidly joined in the URDF"),
            std::string::npos);
}

TEST_F(CheckBag, JointsThatNoJointStateNamesAreNamed) {
  writeHeldContact([](double) { return true; });  // the elbow's
  const ToolRun result = run(check("held.bag", "made"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("joint_states never gives positions of these joints of the robot: elbow\n"),
            std::string::npos)
      << result.error;
  const ToolRun complete = run(check("arm.bag", "whole"));
  EXPECT_EQ(complete.error.find("never gives"), std::string::npos) << complete.error;
}

TEST_F(CheckBag, ThePlanIsATableIfItLeavesOutAllPairs) {
  write("none.yaml", readText(path("arm.yaml")) + "allowed_pairs: [[\"*\", \"*\"]]\n");
  const ToolRun result = run(check("arm.bag", "no", "--config none.yaml"));
  EXPECT_EQ(result.exit_code, kBadInput) << result.error;
  EXPECT_NE(result.error.find("\nsdf_ccd: arm.bag: nothing could be checked, as all pairs are left out\n"),
            std::string::npos)
      << result.error;
  EXPECT_NE(result.error.find("\nhand "), std::string::npos) << result.error;
}

TEST_F(CheckBag, JointStatesGiveWhatTfLacks) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  const std::string contacts = readText(path("made/contacts.csv"));
  {
    rosbag::Bag tf(path("made/checked.bag").string()), mixed(path("mixed.bag").string(), rosbag::bagmode::Write);
    rosbag::Bag joints(path("arm.bag").string());
    for (const rosbag::MessageInstance& message : rosbag::View(tf)) {
      const auto moved = message.instantiate<tf2_msgs::TFMessage>();
      if (!moved) continue;
      auto& all = moved->transforms;
      const auto isForearm = [](const auto& transform) { return transform.child_frame_id == "forearm"; };
      all.erase(std::remove_if(all.begin(), all.end(), isForearm), all.end());
      mixed.write(message.getTopic(), message.getTime(), *moved);
    }
    for (const rosbag::MessageInstance& message : rosbag::View(joints)) {
      mixed.write("joint_states", message.getTime(), *message.instantiate<sensor_msgs::JointState>());
      sensor_msgs::JointState other;
      other.name = {"finger"};
      mixed.write("others", message.getTime(), other);
    }
  }
  const ToolRun filled = run(check("mixed.bag", "filled"));
  EXPECT_EQ(filled.exit_code, kDone) << filled.error;
  EXPECT_NE(filled.out.find("followed by tf, joint_states for 1 link\n"), std::string::npos) << filled.out;
  EXPECT_EQ(readText(path("filled/contacts.csv")), contacts);
  EXPECT_EQ(filled.error.find("warning"), std::string::npos) << filled.error;

  const ToolRun chosen = run(check("mixed.bag", "chosen", "--joint-states /joint_states"));
  EXPECT_EQ(chosen.exit_code, kDone) << chosen.error;
  EXPECT_NE(chosen.out.find("followed by joint_states\n"), std::string::npos) << chosen.out;
  EXPECT_EQ(readText(path("chosen/contacts.csv")), contacts);
  expectRefused(check("mixed.bag", "no", "--joint-states others"),
                "others is not about the robot, its joints are finger");
  expectRefused(check("mixed.bag", "no", "--joint-states none"), "it contains no joint states on none");
}

TEST_F(CheckBag, ARobotThatTheBagIsNotAboutIsRefused) {
  const std::string link = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  write("other.urdf", "<robot name='other'><link name='a'>" + link + "</link><link name='b'>" + link +
                          "</link><joint name='ab' type='continuous'><parent link='a'/><child link='b'/><origin "
                          "xyz='1 0 0'/></joint></robot>");
  expectRefused("check-bag arm.bag --urdf other.urdf --out no",
                "contains no tf, and joint_states is not about the robot, its joints are elbow");
  {
    rosbag::Bag bag(path("prefixed.bag").string(), rosbag::bagmode::Write);
    bag.write("/tf", ros::Time(kBegin), message({stampedTransform("tb1/base", "tb1/hand", kBegin, 0.0)}));
  }
  expectRefused(check("prefixed.bag", "no"), "; tf has tb1/hand: is tf_prefix tb1?");
  write("single.urdf", "<robot name='single'><link name='a'>" + link + "</link></robot>");
  expectRefused("check-bag arm.bag --urdf single.urdf --out no", "the robot has no other links");
  write("map.yaml", "fixed_frame: map\n");
  expectRefused(check("arm.bag", "no", "--config map.yaml"), "the fixed frame map is neither in tf nor a link");
}

TEST_F(CheckBag, PairsThatNameNoBodyAreNamed) {
  write("pairs.yaml", readText(path("arm.yaml")) + "checked_pairs: [[hand, plaet]]\n");
  const ToolRun result = run(check("arm.bag", "made", "--config pairs.yaml"));
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  const std::string warning = "sdf_ccd: warning: checked_pairs: no body is named plaet, did you mean plate?\n";
  EXPECT_EQ(result.error.rfind(warning, 0), 0u) << result.error;  // followed by a warning if gnuplot is missing
}

TEST_F(CheckBag, WhatCannotBeCheckedIsNamed) {
  ::setenv("ROS_PACKAGE_PATH", path("").c_str(), 1);
  const ToolRun result = run(check("arm.bag", "made"));
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("not checked: link hand: package://sdf_ccd/"), std::string::npos) << result.error;
  EXPECT_EQ(table("made/cycles.csv")[0]["verdict"], "NOT_CHECKED");
}

}  // namespace sdf_ccd::check_bag_ends_test
