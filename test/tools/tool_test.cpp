#include "tools/tool_run.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/drawn_meshes.h"
#include "oracle/open_shapes.h"
#include "sdf_ccd/field.h"
#include "shell/point_shell.h"

namespace sdf_ccd::tool_test {

using namespace test;
using Tool = ToolWithBall;

TEST_F(Tool, VersionIsThatOfThePackage) {
  const std::string package = readText(std::string(SDF_CCD_SOURCE_DIR) + "/package.xml"), tag = "<version>";
  const std::size_t begin = package.find(tag) + tag.size();
  EXPECT_EQ(run("--version").out, "sdf_ccd " + package.substr(begin, package.find('<', begin) - begin) + "\n");
}

TEST_F(Tool, HelpIsEverywhere) {
  for (const char* arguments :
       {"--help", "build --help", "info --help", "query --help", "simulate --help", "work-precision --help"}) {
    const ToolRun result = run(arguments);
    EXPECT_EQ(result.exit_code, kDone);
    EXPECT_NE(result.out.find("Usage"), std::string::npos);
    EXPECT_EQ(result.error, "");
  }
}

TEST_F(Tool, BuildWritesAFieldAndAShellOfAMesh) {
  const ToolRun result = run("build --mesh ball.off --out made --resolution 32 --spacing 0.05 --threads 1");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_EQ(result.error, "");
  EXPECT_NE(result.out.find("1280 triangles"), std::string::npos) << result.out;
  EXPECT_EQ(countFiles(), 5u);
  const DistanceField field = loadField(path("made/ball.field").string());
  EXPECT_NEAR(field.sample(Vector3d(0.5, 0, 0)).value, 0.0, field.errorBound() + 0.01);
  EXPECT_LE(loadShell(path("made/ball.shell").string()).covering_radius, 0.05);
}

TEST_F(Tool, BuildRefusesTooMuch) {
  const ToolRun refused = run("build --mesh ball.off --out none --cell 1e-4");
  EXPECT_EQ(refused.exit_code, kBadInput);
  EXPECT_EQ(refused.error.find("sdf_ccd: field: "), 0u) << refused.error;
  EXPECT_NE(refused.error.find(" MB with cells of 0.0001 m, more than the "), std::string::npos) << refused.error;
  EXPECT_NE(refused.error.find(" m would fit\n"), std::string::npos) << refused.error;
  EXPECT_FALSE(fs::exists(path("none")));
  // The shell is refused when the field is there.
  expectRefused("build --mesh ball.off --out none --max-error 0.01 --spacing 1e-5", " needs more than 20000000 points");
  EXPECT_FALSE(fs::exists(path("none")));
  expectRefused("build --mesh ball.off --out none --max-error 1e-7 --max-time 0.5",
                "preparing the mesh takes more than the 0.5 s of --max-time");
  EXPECT_FALSE(fs::exists(path("none")));
}

TEST_F(Tool, QueryAndInfoRefuseTooMuch) {
  EXPECT_EQ(run("query --segments in.csv --out out.csv --mesh ball.off --max-error 0.01").out, "");
  for (const std::string command :
       {"query --segments in.csv --out no.csv --mesh ball.off", "info --slice z=0 --out no.png ball.off"}) {
    expectRefused(command + " --cell 1e-4", " m would fit\n");
    expectRefused(command + " --max-error 1e-7 --max-time 0.5", " takes more than the 0.5 s of --max-time");
  }
}

TEST_F(Tool, InfoTellsWhatFilesHold) {
  ASSERT_EQ(run("build --mesh ball.off --out made --resolution 16").exit_code, kDone);
  EXPECT_NE(run("info made/ball.field").out.find("cells of 0.0625 m"), std::string::npos);
  EXPECT_NE(run("info made/ball.shell").out.find("points"), std::string::npos);
  EXPECT_NE(run("info ball.off").out.find("sign trusted         yes"), std::string::npos);
}

TEST_F(Tool, SaysWhereAMeshIsOpen) {
  write("bin.off", test::off(test::binMesh(0.25)));
  EXPECT_NE(run("info bin.off").out.find("openings             1 opening, the longest 2 m around, 0.25 m^2 of caps"),
            std::string::npos);
  EXPECT_NE(run("info ball.off").out.find("openings             no openings"), std::string::npos);
  ASSERT_EQ(run("build --mesh bin.off --out made --resolution 16").exit_code, kDone);
  ASSERT_EQ(run("build --mesh ball.off --out made --resolution 16").exit_code, kDone);
  EXPECT_NE(run("info made/bin.field").out.find("openings: caps of 0.25 m^2"), std::string::npos);
  EXPECT_NE(run("info made/ball.field").out.find("openings: none"), std::string::npos);
  EXPECT_EQ(run("info made/bin.field --slice y=0.05 --out slice.png").exit_code, kDone);
  const ToolRun query = run("query --field made/bin.field --segments in.csv --out out.csv");
  EXPECT_EQ(query.exit_code, kDone);
  EXPECT_NE(query.error.find("warning: openings: caps of 0.25 m^2"), std::string::npos) << query.error;
}

TEST_F(Tool, WhatIsNotCertainOfAMeshIsWarnedOf) {
  const test::Cupboard cupboard;
  write("cupboard.off", test::off(merged(cupboard.walls, test::flipped(cupboard.shelf))));
  const std::string warning = ": inside and outside are uncertain; 1 component was inside out and has been flipped\n";
  const ToolRun info = run("info cupboard.off");
  EXPECT_EQ(info.exit_code, kDone);
  EXPECT_EQ(info.error, "sdf_ccd: cupboard.off" + warning);
  EXPECT_NE(info.out.find("inverted components  1, 0 of them open\n"), std::string::npos) << info.out;
  write("through.csv", "0,0,-0.2,0,0,0.2\n");
  const ToolRun query = run("query --mesh cupboard.off --segments through.csv --out out.csv --resolution 64");
  EXPECT_EQ(query.exit_code, kDone);
  EXPECT_EQ(query.error.find("sdf_ccd: cupboard.off" + warning), 0u) << query.error;  // and that walls are too thin
  int segment = -1;
  double enter = 0.0, exit = 0.0;
  std::sscanf(readText(path("out.csv")).c_str(), "segment,t_enter,t_exit\n%d,%lf,%lf", &segment, &enter, &exit);
  EXPECT_EQ(segment, 0);
  EXPECT_NEAR(0.4 * (exit - enter), 0.061, 0.01);
  EXPECT_EQ(run("build --mesh cupboard.off --out made --resolution 16").error.find("sdf_ccd: cupboard" + warning), 0u);
  EXPECT_EQ(run("info ball.off").error, "");
}

TEST_F(Tool, SliceIsAPicture) {
  const ToolRun result = run("info ball.off --slice z=-0.1 --out slice.png --resolution 16");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_EQ(readText(path("slice.png")).substr(1, 3), "PNG");
  expectRefused("info ball.off --slice z=5 --out no.png", "misses the field's box");
  expectRefused("info ball.off --slice w=0 --out no.png", "w=0");
  expectRefused("info ball.off --slice z=nan --out no.png", "z=nan");
  expectRefused("info ball.off --slice z=0", "--slice and --out go together");
  expectRefused("info ball.off --slice z=0 --out no/such/place.png", "cannot write");
}

TEST_F(Tool, OutputsThatCannotBeWrittenAreRefusedAndLeaveNothing) {
  expectRefused("query --mesh ball.off --segments in.csv --out no/such/out.csv", "no/such/out.csv: cannot write");
  expectRefused("query --mesh ball.off --segments in.csv --out .", "directory");
  fs::create_symlink("loop.csv", path("loop.csv"));
  expectRefused("query --mesh ball.off --segments in.csv --out loop.csv", "loop.csv: cannot write");
  expectRefused("build --mesh ball.off --out in.csv", "in.csv: cannot write");
  expectRefused("build --mesh ball.off --out in.csv/deeper", "cannot write");
  EXPECT_NE(readText(path("in.csv")).find("-1,0,0,1,0,0"), std::string::npos);
  if (::geteuid() == 0) return;  // root may write everywhere
  fs::permissions(path(""), fs::perms::owner_read | fs::perms::owner_exec);
  expectRefused("query --mesh ball.off --segments in.csv --out out.csv", "cannot write");
}

TEST_F(Tool, LinksStayAndWhatTheyLeadToIsWritten) {
  fs::create_directories(path("far"));
  write("far/there.csv", "old");
  fs::create_symlink("far", path("by"));
  fs::create_symlink("by/there.csv", path("link.csv"));
  fs::create_symlink("far/new.csv", path("dangling.csv"));
  for (const char* link : {"link.csv", "dangling.csv"}) {
    ASSERT_EQ(run("query --mesh ball.off --segments in.csv --out " + std::string(link)).exit_code, kDone);
    EXPECT_TRUE(fs::is_symlink(path(link)));
    EXPECT_EQ(readText(path(link)).find("segment,t_enter,t_exit\n0,"), 0u);
  }
  EXPECT_EQ(readText(path("far/there.csv")), readText(path("far/new.csv")));
  EXPECT_EQ(std::distance(fs::directory_iterator(path("far")), fs::directory_iterator()), 2);
}

TEST_F(Tool, DevicesAndPipesAreWrittenTo) {
  const std::string query = "query --mesh ball.off --segments in.csv --out ";
  const ToolRun result = run(query + "/dev/stdout");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_EQ(result.out.find("segment,t_enter,t_exit\n0,"), 0u) << result.out;
  EXPECT_EQ(run(query + "/dev/stdout | cat").out, result.out);
  EXPECT_EQ(run(query + "/dev/null").exit_code, kDone);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(fs::exists("/dev/stdout"));
  expectRefused(query + "/dev/full", "/dev/full: cannot write");
}

TEST_F(Tool, OptionsThatWouldDoNothingAreRefused) {
  ASSERT_EQ(run("build --mesh ball.off --out made --resolution 12").exit_code, kDone);
  const std::string query = "query --field made/ball.field --segments in.csv --out out.csv ";
  for (const char* option : {"--cell 0.01", "--resolution 20", "--max-error 0.1", "--band 0.2"}) {
    const std::string name = std::string(option).substr(0, std::string(option).find(' '));
    expectRefused(query + option, name + " sets how a field is built");
    expectRefused("info made/ball.field --slice z=0 --out s.png " + std::string(option), name);
    expectRefused("info ball.off " + std::string(option), "a field is built only with --slice");
  }
  expectRefused(query + "--sigma 1e300", "--sigma 1e+300 lies outside the field's band of 0.");
}

TEST_F(Tool, BadMeshesAndOptionsAreRefused) {
  write("garbage.stl", "solid but hollow");
  write("nan.off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  write("empty.obj", "");
  for (const char* mesh : {"garbage.stl", "nan.off", "empty.obj", "missing.stl", "."}) {
    expectRefused("build --mesh " + std::string(mesh) + " --out made", mesh);
    expectRefused("info " + std::string(mesh), mesh);
  }
  expectRefused("build --octomap garbage.stl --out made", "garbage.stl");
  expectRefused("build --mesh ball.off --out made --cell -1", "-1");
  expectRefused("build --mesh ball.off --out made --cell nan", "nan");
  expectRefused("build --mesh ball.off --out made --resolution 0", "0");
  expectRefused("build --mesh ball.off --out made --cell 1e-9", "");  // would need more memory than allowed
  expectRefused("build --mesh ball.off --out made --cell 0.1 --resolution 9", "excludes");
  expectRefused("build --mesh ball.off --out made --spacing 0", "--spacing");
  expectRefused("build --mesh ball.off --out made --threads -1", "--threads");
  expectRefused("build --mesh ball.off --urdf a.urdf --out made", "--urdf");
  expectRefused("build --mesh ball.off --srdf a.srdf --out made", "--srdf needs --urdf");
  expectRefused("build --urdf ball.off --out made", "ball.off: the URDF cannot be parsed");
  expectRefused("build --urdf . --out made", "is a directory");
  write("arm.urdf", "<robot name='arm'><link name='a'/></robot>");
  expectRefused("build --urdf arm.urdf --out made --resolution 1", "the monitor needs two cells or more");
  expectRefused("build --out made", "required");
  expectRefused("", "subcommand");
  expectRefused("fly", "");
}

/// Two links with something between them, so that they are a pair; `c` is added to them.
std::string twoLinks(const std::string& a, const std::string& b, const std::string& c = "") {
  const auto link = [](const std::string& name, const std::string& shapes) {
    return "<link name='" + name + "'>" + shapes + "</link>";
  };
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<joint name='to_" + child + "' type='continuous'><origin xyz='0.6 0 0'/><parent link='" + parent +
           "'/><child link='" + child + "'/></joint>";
  };
  return "<robot name='arm'>" + link("a", a) + link("between", "") + link("b", b) + joint("a", "between") +
         joint("between", "b") + c + "</robot>";
}

const char* const kBall = "<collision><geometry><mesh filename='ball.off'/></geometry></collision>";
const char* const kBox = "<collision><geometry><box size='1 1 1'/></geometry></collision>";

TEST_F(Tool, RobotIsBuiltInFilesOfACache) {
  write("arm.urdf", twoLinks(std::string(kBall) + kBall, kBox));
  const std::string build = "build --urdf arm.urdf --out made --resolution 12 --spacing 0.05";
  const ToolRun first = run(build);
  ASSERT_EQ(first.exit_code, kDone) << first.error;
  EXPECT_NE(first.out.find(" built "), std::string::npos) << first.out;
  const std::string loaded = "; the monitor loads them with cache_directory: " + path("made").string() +
                             ", field: {cells: 12}, shell: {spacing: 0.05} and otherwise default parameters\n";
  EXPECT_NE(first.out.find("\n2 files, "), std::string::npos) << first.out;  // the meshes are equal
  EXPECT_NE(first.out.find(loaded), std::string::npos) << first.out;

  write("made/other.field", "not ours");
  const ToolRun second = run(build);
  EXPECT_EQ(second.exit_code, kDone) << second.error;
  EXPECT_NE(second.out.find(" cached "), std::string::npos) << second.out;
  EXPECT_EQ(second.out.find(" built "), std::string::npos) << second.out;
  EXPECT_EQ(second.out.substr(second.out.find("\n2 files, ")), first.out.substr(first.out.find("\n2 files, ")));
}

TEST_F(Tool, LinksWithoutAMeshAreNamed) {
  write("arm.urdf", twoLinks(kBall, kBox,
                             "<link name='c'><collision><geometry><mesh filename='package://nowhere/x.stl'/></geometry>"
                             "</collision></link><joint name='to_c' type='continuous'><parent link='b'/><child "
                             "link='c'/></joint>"));
  const ToolRun result = run("build --urdf arm.urdf --out made");
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("not checked: link c: package://nowhere/x.stl: no such package"), std::string::npos)
      << result.error;
  EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
  EXPECT_NE(result.out.find("\n2 files, "), std::string::npos) << result.out;
}

TEST_F(Tool, WhatIsLeftOutOfALinksSolidIsReported) {
  const TriangleMesh ball = test::icosphere(0.5, 2);
  write("ball.off", test::off(merged(ball, transformed(ball, Isometry3d(Eigen::Translation3d(0.1, 0.0, 0.0))))));
  write("arm.urdf", twoLinks(kBall, kBox));
  const ToolRun result = run("build --urdf arm.urdf --out made");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find(" inside the solid removed"), std::string::npos) << result.out;
}

TEST_F(Tool, PrimitivesNeedNoFiles) {
  write("arm.urdf", twoLinks(kBox, kBox));
  const ToolRun result = run("build --urdf arm.urdf --out made");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find("\nno files: the bodies that are checked need none\n"), std::string::npos) << result.out;
}

TEST_F(Tool, LearnPairsWritesAnSrdf) {
  ::setenv("ROS_PACKAGE_PATH", SDF_CCD_SOURCE_DIR, 1);
  const std::string command = "learn-pairs --urdf " SDF_CCD_SOURCE_DIR "/config/demo/arm.urdf --max-error 0.02 ";
  const ToolRun result = run(command + "--states 200 --out arm.srdf");
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find("5 Adjacent"), std::string::npos) << result.out;
  const std::string srdf = readText(path("arm.srdf"));
  EXPECT_NE(srdf.find("<disable_collisions link1=\"base\" link2=\"turret\" reason=\"Adjacent\"/>"), std::string::npos);
  EXPECT_NE(srdf.find("NO PROOF"), std::string::npos);
  ASSERT_EQ(run(command + "--states 200 --threads 1 --out again.srdf").exit_code, kDone);
  EXPECT_EQ(readText(path("again.srdf")), srdf);
  // The output may overwrite the given SRDF.
  const ToolRun more = run(command + "--states 200 --srdf arm.srdf --out arm.srdf");
  ASSERT_EQ(more.exit_code, kDone) << more.error;
  EXPECT_NE(more.out.find("no check needed  0"), std::string::npos) << more.out;
  EXPECT_EQ(readText(path("arm.srdf")).find(srdf.substr(0, srdf.find("</robot>"))), 0u);

  expectRefused(command + "--states 0 --out no.srdf", "--states 0 needs --bag");
  expectRefused(command + "--seed -1 --out no.srdf", "--seed must not be negative");
  expectRefused("learn-pairs --urdf arm.urdf --max-error 0 --out no.srdf", "--max-error must be positive");
  expectRefused(command + "--srdf missing.srdf --out no.srdf", "missing.srdf");
  expectRefused("learn-pairs --urdf missing.urdf --out no.srdf",
                "missing.urdf: no such file (" + path("missing.urdf").string() + " does not exist)\n");
  expectRefused(command + "--out nowhere/no.srdf", "nowhere/no.srdf: cannot write");
}

/// Six arms about one axis: all of their 15 pairs touch in some states.
TEST_F(Tool, LearnPairsListsAllThatTouch) {
  std::string urdf = "<robot name='star'><link name='base'/>";
  for (int i = 0; i < 6; ++i) {
    const std::string arm = "arm" + std::to_string(i);
    urdf += "<link name='" + arm +
            "'><collision><origin xyz='1 0 0'/><geometry><sphere radius='0.3'/></geometry></collision></link><joint "
            "name='j" +
            arm + "' type='continuous'><parent link='base'/><child link='" + arm + "'/><axis xyz='0 0 1'/></joint>";
  }
  write("star.urdf", urdf + "</robot>");
  const ToolRun result = run("learn-pairs --urdf star.urdf --max-error 0.05 --states 200 --out star.srdf");
  ASSERT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find("touch            15\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\n  arm4 - arm5\n"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find(" more"), std::string::npos) << result.out;
}

}  // namespace sdf_ccd::tool_test
