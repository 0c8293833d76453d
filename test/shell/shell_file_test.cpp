#include "shell/point_shell.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/file_versions.h"
#include "oracle/files.h"
#include "oracle/mended_file.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"
#include "shell/shell_cache.h"

namespace sdf_ccd::shell_file_test {

class ShellFile : public ::testing::Test {
 protected:
  void SetUp() override {
    shell_.origin = {2, 3, 5};
    shell_.add({1, 2, 3}, {1, 0, 0}, 0.1F);
    shell_.add({4.1, 5.2, 6.3}, {1, 2, -3}, 0.2F);
    shell_.covering_radius = 0.007;
    shell_.edge_radius = 0.001;
    shell_.flatness = 0.0001;
  }

  const test::TemporaryDirectory directory_;
  const std::filesystem::path path_ = directory_ / "two_points.shell";
  PointShell shell_;
};

TEST_F(ShellFile, ComesBackAsItWas) {
  saveShell(shell_, path_.string());
  const PointShell loaded = loadShell(path_.string());
  EXPECT_EQ(loaded.origin, shell_.origin);
  EXPECT_EQ(loaded.points(), shell_.points());
  for (std::size_t i = 0; i < shell_.size(); ++i) EXPECT_EQ(loaded.normal(i), shell_.normal(i));
  EXPECT_EQ(loaded.areas, shell_.areas);
  EXPECT_EQ(loaded.covering_radius, shell_.covering_radius);
  EXPECT_EQ(loaded.edge_radius, shell_.edge_radius);
  EXPECT_EQ(loaded.flatness, shell_.flatness);
  EXPECT_GT(loaded.position_error, 0.0);
  EXPECT_EQ(loaded.position_error, shell_.position_error);
}

TEST_F(ShellFile, EmptyShellComesBack) {
  saveShell({}, path_.string());
  EXPECT_EQ(loadShell(path_.string()).size(), 0u);
}

TEST_F(ShellFile, PartsThatDoNotFitEachOtherAreRefused) {
  saveShell(shell_, path_.string());
  const test::EditedFile good(path_.string(), "shell", test::kShellVersion);
  good.write(path_.string(), [](auto& sections) { sections[3].resize(sizeof(float)); });
  EXPECT_NE(test::failureOf([&] { loadShell(path_.string()); }).find("2 points, 2 normals, 1 areas"),
            std::string::npos);
  shell_.areas.pop_back();
  EXPECT_NE(test::failureOf([&] { saveShell(shell_, path_.string()); }).find("2 points, 2 normals, 1 areas"),
            std::string::npos);
}

/// By saving, and by loading a file with a valid checksum.
TEST_F(ShellFile, NumbersThatAreNoPointsAreRefused) {
  const PointShell good = shell_;
  saveShell(good, path_.string());
  const test::EditedFile file(path_.string(), "shell", test::kShellVersion);
  const auto expectRefused = [&](auto change) {
    shell_ = good;
    change();
    EXPECT_THROW(saveShell(shell_, path_.string()), std::runtime_error);
    const double header[] = {shell_.covering_radius, shell_.edge_radius, shell_.flatness,  shell_.position_error,
                             shell_.origin.x(),      shell_.origin.y(),  shell_.origin.z()};
    file.write(path_.string(), [&](auto& sections) {
      ASSERT_EQ(sections[0].size(), sizeof header);
      std::memcpy(sections[0].data(), header, sections[0].size());
      std::memcpy(sections[1].data(), shell_.offsets.data(), sections[1].size());
      std::memcpy(sections[3].data(), shell_.areas.data(), sections[3].size());
    });
    EXPECT_THROW(loadShell(path_.string()), std::runtime_error);
  };
  for (const double bad : {HUGE_VAL, -HUGE_VAL, std::nan(""), 1e300}) {
    expectRefused([&] { shell_.offsets[1].y() = static_cast<float>(bad); });
    expectRefused([&] { shell_.origin.z() = bad; });
  }
  for (const double bad : {HUGE_VAL, -1e-9, std::nan("")}) {
    expectRefused([&] { shell_.areas[1] = static_cast<float>(bad); });
    expectRefused([&] { shell_.covering_radius = bad; });
    expectRefused([&] { shell_.flatness = bad; });
    expectRefused([&] { shell_.position_error = bad; });
  }
  for (const double bad : {-1e-9, std::nan("")}) expectRefused([&] { shell_.edge_radius = bad; });
  shell_ = good;
  shell_.edge_radius = HUGE_VAL;  // edges were not sampled separately
  saveShell(shell_, path_.string());
  EXPECT_EQ(loadShell(path_.string()).edge_radius, HUGE_VAL);
}

TEST_F(ShellFile, CachedShellsAreHeldToTheLimitOfPoints) {
  const FileCache cache(directory_.string());
  const TriangleMesh box = test::boxMesh({0.2, 0.1, 0.1});
  ShellOptions options;
  options.spacing = 0.05;
  const std::size_t points = cachedShell(cache, box, options).shell.size();
  EXPECT_TRUE(cachedShell(cache, box, options).outcome.from_cache);
  options.max_points = points - 1;
  EXPECT_THROW(cachedShell(cache, box, options), std::length_error);
}

TEST_F(ShellFile, EveryTruncationIsRefused) {
  saveShell(shell_, path_.string());
  const std::string bytes = test::readText(path_);
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    test::writeText(path_, bytes.substr(0, size));
    EXPECT_THROW(loadShell(path_.string()), std::runtime_error) << size;
  }
}

}  // namespace sdf_ccd::shell_file_test
