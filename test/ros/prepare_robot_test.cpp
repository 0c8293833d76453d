#include "check_bag_case.h"

namespace sdf_ccd::test::prepare_robot_test {

/// The monitor loads what `build --urdf` has made; check-bag starts like the monitor.
class PrepareRobot : public CheckBag {
 protected:
  void SetUp() override {
    CheckBag::SetUp();
    const std::string text = readText(path("arm.yaml"));
    write("copied.yaml", text.substr(0, text.find("cache_directory: cache")) + "cache_directory: copied" +
                             text.substr(text.find("cache_directory: cache") + 22));
  }

  std::string build(const std::string& options) const {
    return "build --urdf " SDF_CCD_SOURCE_DIR "/config/demo/arm.urdf " + options + " --out prepared";
  }
  std::vector<std::string> filesIn(const std::string& directory) const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(path(directory))) {
      if (entry.path().extension() != ".lock") names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

TEST_F(PrepareRobot, IsLoadedWhereItWasCopiedTo) {
  const ToolRun prepared = run(build("--config arm.yaml"));
  ASSERT_EQ(prepared.exit_code, kDone) << prepared.error;
  EXPECT_NE(prepared.out.find("; the monitor loads them with cache_directory: "), std::string::npos) << prepared.out;
  const std::vector<std::string> files = filesIn("prepared");
  EXPECT_FALSE(files.empty());
  fs::copy(path("prepared"), path("copied"));
  fs::permissions(path("copied"), fs::perms::owner_all);  // no one else may write to it, whatever the umask
  fs::remove_all(path("prepared"));

  const ToolRun checked = run(check("arm.bag", "made", "--config copied.yaml"));
  ASSERT_EQ(checked.exit_code, kDone) << checked.error;
  const std::string plan = readText(path("made/plan.txt"));
  EXPECT_NE(plan.find("cached"), std::string::npos) << plan;
  EXPECT_EQ(plan.find("built"), std::string::npos) << plan;
  EXPECT_EQ(plan.find("warning"), std::string::npos) << plan;
  EXPECT_EQ(filesIn("copied"), files);
}

TEST_F(PrepareRobot, ParametersAreTheMonitorsDefaultsAndOptions) {
  const std::pair<const char*, const char*> cases[] = {
      {"", ""},
      {"--cell 0.006 --band 0.04 --spacing 0.003", "field: {cell_size: 0.006, band: 0.04}\nshell: {spacing: 0.003}\n"},
      {"--max-error 0.004", "field: {max_error: 0.004}\n"},
      {"--resolution 20", "field: {cells: 20}\n"}};
  for (const auto& [options, parameters] : cases) {
    fs::remove_all(path("prepared"));
    ASSERT_EQ(run(build(options)).exit_code, kDone) << options;
    const std::vector<std::string> files = filesIn("prepared");
    EXPECT_EQ(files.size(), 10u) << options;
    write("plain.yaml", "cache_directory: prepared\n" + std::string(parameters));
    const ToolRun checked = run(check("arm.bag", "made", "--config plain.yaml"));
    ASSERT_EQ(checked.exit_code, kDone) << checked.error;
    const std::string plan = readText(path("made/plan.txt"));
    EXPECT_NE(plan.find("cached"), std::string::npos) << plan;
    EXPECT_EQ(plan.find("built"), std::string::npos) << plan;
    EXPECT_EQ(filesIn("prepared"), files) << options;
  }
}

TEST_F(PrepareRobot, OtherParametersMakeTheirOwn) {
  ASSERT_EQ(run(build("--config arm.yaml")).exit_code, kDone);
  fs::rename(path("prepared"), path("copied"));
  const std::size_t files = filesIn("copied").size();
  std::string finer = readText(path("copied.yaml"));
  finer.replace(finer.find("0.006"), 5, "0.005");
  write("finer.yaml", finer);
  ASSERT_EQ(run(check("arm.bag", "made", "--config finer.yaml")).exit_code, kDone);
  EXPECT_NE(readText(path("made/plan.txt")).find("built"), std::string::npos);
  EXPECT_GT(filesIn("copied").size(), files);
}

TEST_F(PrepareRobot, SaysWhatItCannotDo) {
  expectRefused("build --mesh a.stl --config arm.yaml --out prepared", "--config needs --urdf");
  expectRefused(build("--config arm.yaml --cell 0.01"), "with --config, the resolution comes from that file");
  expectRefused(build("--config arm.yaml --spacing 0.01"), "with --config, shell/spacing of that file counts");
  expectRefused(build("--config none.yaml"), "none.yaml");
  write("prepared", "a file");
  const ToolRun result = run(build("--config arm.yaml"));
  EXPECT_EQ(result.exit_code, kBadInput);
  EXPECT_NE(result.error.find("prepared"), std::string::npos) << result.error;
}

}  // namespace sdf_ccd::test::prepare_robot_test
