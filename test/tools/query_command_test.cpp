#include <algorithm>
#include <cstdio>
#include <limits>
#include <vector>

#include "oracle/open_shapes.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"
#include "tools/tool_run.h"

namespace sdf_ccd::query_command_test {

using namespace test;
using QueryCommand = test::ToolWithBall;

TEST_F(QueryCommand, EqualsTheLibrary) {
  ASSERT_EQ(run("build --mesh ball.off --out made --resolution 24").exit_code, kDone);
  const ToolRun result = run("query --field made/ball.field --segments in.csv --out out.csv");
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  std::istringstream lines(readText(path("out.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "segment,t_enter,t_exit");

  const DistanceField field = loadField(path("made/ball.field").string());
  const std::vector<Segment> segments = {{{-1, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 1}}};
  for (const int i : {0, 2}) {  // segment 1 misses the ball
    const Intervals intervals = segmentIntervals(field, segments[i / 2]);
    ASSERT_EQ(intervals.size(), 1u);
    int segment = -1;
    double enter = -1.0, exit = -1.0;
    std::getline(lines, line);
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%lf,%lf", &segment, &enter, &exit), 3) << line;
    EXPECT_EQ(segment, i);
    EXPECT_EQ(enter, intervals[0].enter);
    EXPECT_EQ(exit, intervals[0].exit);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(QueryCommand, TakesAMeshAnIsovalueAndOnlyTheFirst) {
  write("two.off", test::off(merged(test::translated(test::icosphere(0.2, 2), {-0.5, 0, 0}),
                                    test::translated(test::icosphere(0.2, 2), {0.5, 0, 0}))));
  write("one.csv", "-1,0,0,1,0,0\r\n\r\n");
  const auto rows = [&](const std::string& more) {
    const ToolRun result = run("query --mesh two.off --segments one.csv --out out.csv --resolution 40 " + more);
    EXPECT_EQ(result.exit_code, kDone) << result.error;
    std::vector<std::string> lines;
    std::istringstream stream(readText(path("out.csv")));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  };
  EXPECT_EQ(rows("").size(), 3u);
  EXPECT_EQ(rows("--first").size(), 2u);
  double enter = 0.0;
  ASSERT_EQ(std::sscanf(rows("--sigma -0.05").at(1).c_str(), "0,%lf", &enter), 1);
  EXPECT_NEAR(enter, (1.0 - 0.5 - 0.15) / 2.0, 0.01);
}

TEST_F(QueryCommand, TellsBoundsOfImpactAndDepth) {
  ASSERT_EQ(run("build --mesh ball.off --out made --max-error 0.002").exit_code, kDone);
  ASSERT_EQ(run("query --field made/ball.field --segments in.csv --out out.csv --impact").exit_code, kDone);
  std::istringstream lines(readText(path("out.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "segment,t_earliest,t,t_latest,depth,depth_low,depth_high");
  // The ball's polyhedron is convex, so the depth is the distance below the nearest face's plane.
  const TriangleMesh ball = test::icosphere(0.5, 3);
  const auto trueDepth = [&](const Vector3d& p) {
    double depth = std::numeric_limits<double>::infinity();
    for (const Vector3i& t : ball.triangles) {
      const Vector3d &a = ball.vertices[t[0]], &b = ball.vertices[t[1]], &c = ball.vertices[t[2]];
      depth = std::min(depth, (b - a).cross(c - a).normalized().dot(a - p));
    }
    return depth;
  };
  const Segment first{{-1, 0, 0}, {1, 0, 0}};
  int segment = -1;
  double earliest, time, latest, depth, low, high;
  std::getline(lines, line);
  ASSERT_EQ(
      std::sscanf(line.c_str(), "%d,%lf,%lf,%lf,%lf,%lf,%lf", &segment, &earliest, &time, &latest, &depth, &low, &high),
      7)
      << line;
  EXPECT_EQ(segment, 0);
  EXPECT_LE(earliest, time);
  EXPECT_LE(time, latest);
  const auto at = [&](double t) -> Vector3d { return first.start + t * (first.end - first.start); };
  EXPECT_LT(trueDepth(at(earliest - 1e-9)), 0.0);
  EXPECT_GT(trueDepth(at(latest + 1e-9)), 0.0);
  double deepest = 0.0;
  for (int k = 0; k <= 1000; ++k) deepest = std::max(deepest, trueDepth(at(k / 1000.0)));
  EXPECT_LE(low, deepest + 1e-9);
  EXPECT_GE(high, deepest);
  EXPECT_NEAR(depth, deepest, high - low);
  EXPECT_LE(low, depth);
  EXPECT_LE(depth, high);
  // A segment that enters through an opening meets at most its cap.
  write("bin.off", test::off(test::binMesh(0.1)));
  write("drop.csv", "0,0,1,0,0,0.05\n");
  ASSERT_EQ(run("query --mesh bin.off --segments drop.csv --out drop_out.csv --impact --max-error 0.002").exit_code,
            kDone);
  std::istringstream dropped(readText(path("drop_out.csv")));
  std::getline(dropped, line);
  std::getline(dropped, line);
  std::vector<std::string> cells;
  std::istringstream row(line);
  for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
  ASSERT_EQ(cells.size(), 7u) << line;
  EXPECT_EQ(cells[3], "") << "it may meet nothing";
  EXPECT_EQ(cells[5], "") << "it may be in nothing";
  expectRefused("query --field made/ball.field --segments in.csv --out b.csv --impact --first", "--sigma or --first");
}

TEST_F(QueryCommand, RefusesBadSegmentsByLine) {
  const std::string query = "query --mesh ball.off --out out.csv --segments ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"1,2,3,4,5,nan\n", ":1: \"nan\" is not finite"},
      {"a,b,c,d,e,f\n1,2,3,4,5,6\n", ":1: \"a\" is not a number"},
      {"0;0;0;1;1;1\n0;0;0;1;1;2\n", ":1: expected six numbers ox,oy,oz,ex,ey,ez, got 1"},
      {"Ox, oy, oz, ex, ey, ez\r\n1,2,3,4,5,inf\n", ":2: \"inf\" is not finite"},
      {"1,2,3,4,5\n", ":1: expected six numbers"},
      {"1,2,3,4,5,6,\n", ":1: expected six numbers"},
      {"1,2,3,4,5,6\nox,oy,oz,ex,ey,ez\n", ":2: \"ox\" is not a number"},
      {"1,2,x,4,5,6\n", ":1: \"x\" is not a number"},
      {"1,2,3,4,5,1e999\n", ":1: \"1e999\" is not finite"},
      {"1,2,3,4,5,6\n1,2,3,4,5,1e13\n", ":2: the segment reaches farther than 1e12 m"},
      {"ox,oy,oz,ex,ey,ez\n", "contains no segment"},
      {"", "contains no segment"},
      {std::string("\0\xff\0", 3), ":1: expected six numbers"}};
  for (const auto& [text, reason] : cases) {
    write("bad.csv", text);
    expectRefused(query + "bad.csv", reason);
  }
  expectRefused(query + "missing.csv", "missing.csv: cannot be opened");
  expectRefused(query + ".", "is a directory");
}

TEST_F(QueryCommand, RefusesDamagedFields) {
  ASSERT_EQ(run("build --mesh ball.off --out made --resolution 12").exit_code, kDone);
  const std::string bytes = readText(path("made/ball.field"));
  write("short.field", bytes.substr(0, bytes.size() / 2));
  write("empty.field", "");
  std::string flipped = bytes;
  flipped[flipped.size() / 2] ^= 1;
  write("flipped.field", flipped);
  for (const char* field :
       {"short.field", "empty.field", "flipped.field", "missing.field", "ball.off", "made", "made/ball.shell"}) {
    expectRefused("query --field " + std::string(field) + " --segments in.csv --out out.csv", field);
  }
  expectRefused("info short.field", "short.field");
  expectRefused("query --field made/ball.field --segments in.csv --out ./in.csv", "the same file");
  expectRefused("query --field made/ball.field --segments in.csv --out out.csv --sigma 9", "band");
  expectRefused("query --field made/ball.field --segments in.csv --out out.csv --sigma nan", "sigma");
}

TEST_F(QueryCommand, KeepsTheOldOutputIfItFails) {
  write("out.csv", "old");
  write("bad.csv", "1,2,3");
  EXPECT_EQ(run("query --mesh ball.off --segments bad.csv --out out.csv").exit_code, kBadInput);
  EXPECT_EQ(readText(path("out.csv")), "old");
}

}  // namespace sdf_ccd::query_command_test
