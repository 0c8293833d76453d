#include <gtest/gtest.h>

#include "tools/tool_run.h"

namespace sdf_ccd::work_precision_command_test {

using namespace test;
using Tool = ToolWithBall;

TEST_F(Tool, WorkPrecisionWritesATableAndAPlot) {
  const bool has_gnuplot = std::system("gnuplot --version > /dev/null 2>&1") == 0;
  const ToolRun result = run("work-precision cell --quick --queries 20 --mesh ball.off --out study");
  EXPECT_EQ(result.exit_code, has_gnuplot ? kDone : kPartlyDone) << result.error;
  EXPECT_NE(result.out.find("time of impact"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("31.2 mm"), std::string::npos) << result.out;  // a ball of 1 m in 32 cells
  std::istringstream csv(readText(path("study/cell.csv")));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "study,quantity,error_unit,system,setting,value,seconds_per_query,error_median,error_p99,error_max,bound,"
            "missed,queries");
  int rows = 0;
  for (; std::getline(csv, line); ++rows) EXPECT_EQ(line.substr(0, 5), "cell,");
  EXPECT_EQ(rows, 12);  // hits, batched hits and depths at four cell sizes
  EXPECT_EQ(fs::exists(path("study/cell.svg")), has_gnuplot);
  EXPECT_EQ(fs::exists(path("study/cell.svg.part")), false);
}

TEST_F(Tool, WorkPrecisionWithoutGnuplotKeepsTheNumbers) {
  const std::string search = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const ToolRun result = run("work-precision cell --quick --queries 20 --mesh ball.off --out study");
  ::setenv("PATH", search.c_str(), 1);
  EXPECT_EQ(result.exit_code, kPartlyDone);
  EXPECT_NE(result.error.find("gnuplot not found"), std::string::npos) << result.error;
  EXPECT_TRUE(fs::exists(path("study/cell.csv")));
  EXPECT_FALSE(fs::exists(path("study/cell.svg")));
}

TEST_F(Tool, WorkPrecisionRefusesWhatItCannotMeasure) {
  expectRefused("work-precision speed --out study", "unknown study `speed`; known: cell, max-error");
  expectRefused("work-precision cell --queries 3 --out study", "--queries");
  expectRefused("work-precision cell --queries 0 --out study", "--queries");
  expectRefused("work-precision cell --mesh missing.stl --out study", "missing.stl");
  write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  expectRefused("work-precision cell --mesh open.off --out study", "inside and outside must be certain");
}

}  // namespace sdf_ccd::work_precision_command_test
