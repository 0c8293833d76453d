// What the tool reads from, and writes to, what is no plain file in the expected form.
#include <chrono>

#include "oracle/german_locale.h"
#include "tools/tool_run.h"

namespace sdf_ccd::streams_test {

using namespace test;
using ToolStreams = ToolWithBall;

constexpr double kSeconds = 5.0;  // for a loaded computer; usually a hundredth of it

TEST_F(ToolStreams, EndlessSegmentsAreRefusedAtOnce) {
  fs::create_symlink("/dev/zero", path("zero.csv"));
  ASSERT_EQ(std::system(("mkfifo '" + path("pipe.csv").string() + "'").c_str()), 0);
  for (const char* endless : {"/dev/zero", "zero.csv", "pipe.csv"}) {
    const auto start = std::chrono::steady_clock::now();
    expectRefused(std::string("query --mesh ball.off --out out.csv --segments ") + endless,
                  std::string(endless) + ": is not a regular file");
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), kSeconds);
  }
}

TEST_F(ToolStreams, AFullStandardOutputIsNoSuccess) {
  for (const char* command : {"build --mesh ball.off --out made --resolution 12", "info ball.off", "--help"}) {
    const ToolRun result = run(std::string(command) + " > /dev/full; echo $?");
    EXPECT_EQ(result.out, std::to_string(kPartlyDone) + "\n") << command;
  }
}

TEST_F(ToolStreams, NoControlCharacterOfAFileReachesTheTerminal) {
  write("bad.csv", "0,0,0,\x1b[2J\x1b]0;renamed\a,1,1\n");
  write("bad.urdf",
        "<robot name='r'><link name='&#27;[31mred\xc2\x9b 31m'/><joint name='&#27;c' type='fixed'/></robot>");
  write("two.urdf", "<robot name='&#27;]0;x&#7;'><link name='&#27;[2Ja'/><link name='b\x7f'/></robot>");
  const std::string csi = "\xc2\x9b";
  for (const char* command :
       {"query --mesh ball.off --segments bad.csv --out out.csv", "build --urdf bad.urdf --out made",
        "build --urdf two.urdf --out made", "learn-pairs --urdf two.urdf --out a.srdf", "info '\x1b[2J.off'",
        "build --mesh '\x1b[2J.stl' --out made"}) {
    const ToolRun result = run(command);
    const std::string all = result.out + result.error;
    EXPECT_NE(all, "") << command;
    for (const char control : {'\x1b', '\a', '\x7f', '\r'}) EXPECT_EQ(all.find(control), std::string::npos) << all;
    EXPECT_EQ(all.find(csi), std::string::npos) << all;
  }
}

TEST_F(ToolStreams, AnEmptyValueIsRefused) {
  write("arm.urdf", "<robot name='r'><link name='a'/></robot>");
  for (const char* command :
       {"build --urdf arm.urdf --srdf '' --out made", "learn-pairs --urdf arm.urdf --srdf '' --out a.srdf",
        "build --urdf '' --out made", "build --mesh ball.off --out ''", "info ''",
        "query --mesh ball.off --segments '' --out out.csv", "build --mesh ball.off --out made --resolution ''"})
    expectRefused(command, "it is empty: give a value, or leave the option out");
}

TEST_F(ToolStreams, NumbersAreTheSameInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  write("in.csv", "ox,oy,oz,ex,ey,ez\n-1.25,0.125,0,1.25,0.125,0\n");
  const std::string query = "query --mesh ball.off --segments in.csv --sigma 0.05 --max-error 0.01 --out ";
  ASSERT_EQ(run(query + "plain.csv").exit_code, kDone);
  const std::string info = run("info ball.off").out;
  ::setenv("LOCPATH", germanLocaleFolder().c_str(), 1);
  ::setenv("LD_PRELOAD", SDF_CCD_GERMAN_LOCALE, 1);
  const ToolRun german = run(query + "german.csv"), german_info = run("info ball.off");
  ::unsetenv("LD_PRELOAD");
  ::unsetenv("LOCPATH");
  EXPECT_EQ(german.exit_code, kDone) << german.error;
  EXPECT_EQ(readText(path("german.csv")), readText(path("plain.csv")));
  EXPECT_EQ(german_info.out, info);
}

TEST_F(ToolStreams, WhatIsNoUrdfIsSaid) {
  write("model.sdf", "<?xml version='1.0'?><sdf version='1.6'><model name='m'><link name='a'/></model></sdf>");
  write("a.xacro",
        "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:macro name='m' params='x'><link name='${x}'/>"
        "</xacro:macro><xacro:m x='a'/></robot>");
  write("scene.xml", "<mujoco model='m'/>");
  for (const std::string command : {"build --out made --urdf ", "learn-pairs --out a.srdf --urdf "}) {
    expectRefused(command + "model.sdf", "model.sdf: the URDF cannot be parsed: its root is <sdf>, not <robot>");
    expectRefused(command + "a.xacro", "line 1 of the URDF: xacro has not expanded it");
    expectRefused(command + "scene.xml", "its root is <mujoco>, not <robot>");
  }
}

}  // namespace sdf_ccd::streams_test
