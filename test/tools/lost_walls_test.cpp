// Walls that are too thin for a field's cells: never lost without a word.
#include <algorithm>
#include <cstdio>
#include <string>

#include "tools/tool_run.h"

namespace sdf_ccd::lost_walls_test {

using namespace test;

/// A plate 1 mm thick, and a small block beside it, so that the grid is not centred on the plate. Ten segments go
/// through the plate.
class LostWalls : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    write("plate.off",
          off(merged(boxMesh({0.1, 0.1, 0.0005}), translated(boxMesh({0.01, 0.01, 0.0137}), {0.3, 0, 0.0373}))));
    std::string rows = "ox,oy,oz,ex,ey,ez\n";
    for (int i = 0; i < 10; ++i) {
      const std::string xy = std::to_string(-0.083 + 0.0171 * i) + "," + std::to_string(0.071 - 0.0153 * i);
      rows += xy + ",0.0231," + xy + ",-0.0527\n";
    }
    write("in.csv", rows);
  }

  /// Rows of the output of a query of in.csv.
  int intervals() {
    const std::string text = readText(path("out.csv"));
    return static_cast<int>(std::count(text.begin(), text.end(), '\n')) - 1;
  }
};

const std::string kLost = "too thin for this field";

TEST_F(LostWalls, AQueryNamesThem) {
  for (const char* cell : {"0.002", "0.004", "0.008"}) {
    const ToolRun run = this->run("query --mesh plate.off --segments in.csv --out out.csv --cell " + std::string(cell));
    EXPECT_EQ(run.exit_code, kDone);
    EXPECT_TRUE(intervals() == 10 || run.error.find(kLost) != std::string::npos) << cell << ": " << run.error;
    EXPECT_EQ(run.error.find('\n'), run.error.size() - 1) << run.error;
  }
  EXPECT_NE(run("query --mesh plate.off --segments in.csv --out out.csv --cell 0.004 --impact").error.find(kLost),
            std::string::npos);
}

TEST_F(LostWalls, FineCellsKeepThem) {
  const ToolRun run = this->run("query --mesh plate.off --segments in.csv --out out.csv --cell 0.0005");
  EXPECT_EQ(intervals(), 10);
  EXPECT_EQ(run.error, "");
}

/// 64 cells along the longest side would be 6 mm each.
TEST_F(LostWalls, TheDefaultKeepsThem) {
  const ToolRun run = this->run("query --mesh plate.off --segments in.csv --out out.csv");
  EXPECT_EQ(intervals(), 10) << run.error;
  EXPECT_EQ(run.error, "");
}

/// What cannot be kept within the limits is named, with the thickness that is.
TEST_F(LostWalls, TheDefaultNamesWhatItCannotKeep) {
  write("foil.off",
        off(merged(boxMesh({0.1, 0.1, 5e-6}), translated(boxMesh({0.01, 0.01, 0.0137}), {0.3, 0, 0.0373}))));
  const ToolRun run = this->run("query --mesh foil.off --segments in.csv --out out.csv");
  EXPECT_EQ(run.exit_code, kDone);
  EXPECT_NE(run.error.find(kLost), std::string::npos) << run.error;
  EXPECT_NE(run.error.find("walls of up to 1e-05 m"), std::string::npos) << run.error;
}

/// The file of a field holds the share; those of both kinds of cells.
TEST_F(LostWalls, TheFieldsFileHoldsTheShare) {
  for (const char* option : {"--cell 0.004", "--max-error 0.003"}) {
    const ToolRun built = run("build --mesh plate.off --out made " + std::string(option));
    EXPECT_EQ(built.exit_code, kDone);
    EXPECT_NE(built.error.find(kLost), std::string::npos) << built.error;
    const ToolRun info = run("info made/plate.field");
    const std::size_t at = info.out.find("thin walls: ");
    ASSERT_NE(at, std::string::npos) << info.out;
    // Both sides of the plate, and none of its edges nor of the block: 0.08 of 0.0838 m^2.
    double percent = 0.0;
    ASSERT_EQ(std::sscanf(info.out.c_str() + at, "thin walls: %lf %%", &percent), 1) << info.out;
    EXPECT_NEAR(percent, 95.5, 1.5) << option;
    EXPECT_NE(run("query --field made/plate.field --segments in.csv --out out.csv").error.find(kLost),
              std::string::npos);
  }
}

/// Rounded edges are no lost walls.
TEST_F(LostWalls, ThickSolidsLoseNothing) {
  const Isometry3d turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  write("box.off", off(transformed(boxMesh({0.1, 0.2, 0.15}), turn)));
  write("ball.off", off(icosphere(0.2, 3)));
  for (const char* name : {"box", "ball"}) {
    const ToolRun built = run("build --mesh " + std::string(name) + ".off --out made --resolution 16");
    EXPECT_EQ(built.exit_code, kDone);
    EXPECT_EQ(built.error, "");
    EXPECT_NE(run("info made/" + std::string(name) + ".field").out.find("thin walls: all kept (0 %"),
              std::string::npos);
  }
}

}  // namespace sdf_ccd::lost_walls_test
