#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "oracle/files.h"
#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"

namespace sdf_ccd::test {

namespace fs = std::filesystem;

constexpr int kDone = 0;
constexpr int kPartlyDone = 1;
constexpr int kBadInput = 2;

struct ToolRun {
  int exit_code;
  std::string out;
  std::string error;
};

/// Text without lines of progress, which appear when work takes over a second, as on a loaded computer.
inline std::string withoutProgress(const std::string& text) {
  std::istringstream lines(text);
  std::string line, rest;
  while (std::getline(lines, line)) {
    if (line.empty() || line.back() != '%') rest += line + "\n";
  }
  return rest;
}

/// Runs the tool in a temporary directory, which is removed after the test.
class ToolTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(directory_ / "work"); }
  void TearDown() override { fs::permissions(directory_ / "work", fs::perms::owner_all); }

  /// Runs the tool in the work directory.
  ToolRun run(const std::string& arguments) {
    const std::string command = "cd '" + (directory_ / "work").string() + "' && '" SDF_CCD_TOOL "' " + arguments +
                                " > ../out.txt 2> ../error.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(directory_ / "out.txt"),
            withoutProgress(readText(directory_ / "error.txt"))};
  }

  /// Expects that the tool refuses: exit code 2, one line on stderr that holds `reason`, and no new file.
  void expectRefused(const std::string& arguments, const std::string& reason) {
    const std::size_t files = countFiles();
    const ToolRun result = run(arguments);
    EXPECT_EQ(result.exit_code, kBadInput) << arguments;
    EXPECT_NE(result.error.find(reason), std::string::npos) << arguments << ": " << result.error;
    EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
    EXPECT_EQ(countFiles(), files) << arguments;
  }

  std::size_t countFiles() const {
    const fs::recursive_directory_iterator files(directory_ / "work");
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

  fs::path path(const std::string& name) const { return directory_ / "work" / name; }
  void write(const std::string& name, const std::string& bytes) { writeText(path(name), bytes); }

  const TemporaryDirectory directory_;
};

/// With the mesh of a ball (ball.off) and three segments (in.csv), of which the second misses the ball.
class ToolWithBall : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    write("ball.off", off(icosphere(0.5, 3)));
    write("in.csv", "ox,oy,oz,ex,ey,ez\n-1,0,0,1,0,0\n-1,2,0,1,2,0\n0,0,0,0,0,1\n");
  }
};

}  // namespace sdf_ccd::test
