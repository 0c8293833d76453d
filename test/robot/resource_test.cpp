#include "sdf_ccd/robot.h"

#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/files.h"

namespace sdf_ccd::resource_test {

namespace fs = std::filesystem;

class ResourceFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    write("a/b/c_folder/package.xml",
          "<package format=\"2\">\n <!-- -- -->\n <name> arm_description </name></package>");
    write("a/b/c_folder/Meshes/Link.STL", "steel");
    write("a/b/c_folder/nested/package.xml", "<package><name>nested</name></package>");
    write("a/old_stack/manifest.xml", "<package/>");
    write("a/ignored/CATKIN_IGNORE", "");
    write("a/ignored/package.xml", "<package><name>ignored</name></package>");
    write("a/other_build/COLCON_IGNORE", "");
    write("a/other_build/x/package.xml", "<package><name>other_build</name></package>");
    write("a/.hidden/package.xml", "<package><name>hidden</name></package>");
    write("a/broken/package.xml", "<package><name>broken");
    write("b/copy/package.xml", "<package><name>arm_description</name></package>");
    const std::string path = (directory_ / "a").string() + "/:/no/such/place::" + (directory_ / "b").string();
    ::setenv("ROS_PACKAGE_PATH", path.c_str(), 1);
    find_ = packagesFromEnvironment();
  }
  void TearDown() override { ::unsetenv("ROS_PACKAGE_PATH"); }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((directory_ / name).parent_path());
    test::writeText(directory_ / name, text);
  }

  std::string failure(const std::string& uri) {
    const std::string failure = test::failureOf([&] { loadLocalResource(uri, find_, directory_.string()); });
    EXPECT_NE(failure.find(uri), std::string::npos) << failure;
    return failure;
  }

  const test::TemporaryDirectory directory_;
  PackageFinder find_;
};

TEST_F(ResourceFiles, PackageIsNamedByItsFileNotItsFolder) {
  EXPECT_EQ(find_("arm_description"), (directory_ / "a/b/c_folder").string());
  EXPECT_EQ(find_("c_folder"), "");
  EXPECT_EQ(find_("old_stack"), (directory_ / "a/old_stack").string());
}

TEST_F(ResourceFiles, CrawlStopsWhereRospackStops) {
  for (const char* name : {"nested", "ignored", "other_build", "hidden", "broken"}) EXPECT_EQ(find_(name), "") << name;
}

TEST_F(ResourceFiles, LoopsOfLinksAreNotFollowed) {
  for (const char* name : {"a/b/up", "a/b/again", "a/b/too"})
    fs::create_directory_symlink(directory_ / "a", directory_ / name);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(packagesFromEnvironment()("nested"), "");
  EXPECT_EQ(packagesFromEnvironment()("arm_description"), (directory_ / "a/b/c_folder").string());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST_F(ResourceFiles, NoPackagePathFindsNothing) {
  ::unsetenv("ROS_PACKAGE_PATH");
  EXPECT_EQ(packagesFromEnvironment()("arm_description"), "");
}

TEST_F(ResourceFiles, EveryKindOfUriIsRead) {
  const std::string mesh = (directory_ / "a/b/c_folder/Meshes/Link.STL").string();
  for (const std::string& uri :
       {std::string("package://arm_description/Meshes/Link.STL"),
        std::string("package:///arm_description/Meshes/Link.STL"), "file://" + mesh, mesh,
        std::string("a/b/c_folder/Meshes/Link.STL"), std::string("b/../a/b/c_folder/Meshes/Link.STL")}) {
    const Resource resource = loadLocalResource(uri, find_, directory_.string());
    EXPECT_EQ(resource.bytes, "steel") << uri;
    EXPECT_EQ(fs::path(resource.name).filename(), "Link.STL");
    EXPECT_EQ(resource.warning, "");
  }
}

TEST_F(ResourceFiles, EscapedCharactersAreTakenWhereTheFileIsNotSpelledSo) {
  write("a/b/c_folder/my link.stl", "blank");
  write("a/b/c_folder/per%20cent.stl", "percent");
  EXPECT_EQ(loadLocalResource("package://arm_description/my%20link.stl", find_, "").bytes, "blank");
  EXPECT_EQ(loadLocalResource("package://arm_description/my link.stl", find_, "").bytes, "blank");
  EXPECT_EQ(loadLocalResource("package://arm_description/per%20cent.stl", find_, "").bytes, "percent");
  for (const char* uri : {"package://arm_description/no%20link.stl", "package://arm_description/my%00link.stl",
                          "package://arm_description/my%2"})
    failure(uri);
}

TEST_F(ResourceFiles, OtherCaseIsTakenWithAWarning) {
  const Resource resource = loadLocalResource("package://arm_description/meshes/link.stl", find_, "");
  EXPECT_EQ(resource.bytes, "steel");
  EXPECT_EQ(
      resource.warning,
      "package://arm_description/meshes/link.stl: found Meshes, the URI says meshes, found Link.STL, the URI says "
      "link.stl");
}

TEST_F(ResourceFiles, FailuresNameTheUriAndTheReason) {
  EXPECT_NE(failure("package://arm_descriptions/x.stl").find("no such package: arm_descriptions"), std::string::npos);
  EXPECT_NE(failure("package://arm_description/x.stl").find("no such file"), std::string::npos);
  EXPECT_NE(failure("package://arm_description/../x.stl").find(".."), std::string::npos);
  EXPECT_NE(failure("package://arm_description/Meshes").find("is a directory"), std::string::npos);
  EXPECT_NE(failure("package://arm_description/Meshes/").find("is a directory"), std::string::npos);
  EXPECT_NE(failure("package://arm_description").find("names no file"), std::string::npos);
  EXPECT_NE(failure("package://").find("names no file"), std::string::npos);
  for (const char* start : {"package://", "file:///", "", "gopher://", "package://arm_description/"}) {
    for (const char* part : {"a", "a/", "../", "./", "\033\n"}) {
      std::string uri = start;
      while (uri.size() < 1'000'000) uri += part;
      const std::string failure = test::failureOf([&] { loadLocalResource(uri, find_, directory_.string()); });
      EXPECT_NE(failure, "") << start << part;
      EXPECT_LT(failure.size(), 1000u);
      EXPECT_EQ(failure.find_first_of("\n\033"), std::string::npos);
    }
  }
  EXPECT_NE(failure("ftp://example.org/x.stl").find("ftp:// is not supported"), std::string::npos);
  EXPECT_NE(failure("https://example.org/x.stl").find("https:// is not supported"), std::string::npos);
  EXPECT_NE(failure("file://x.stl").find("absolute"), std::string::npos);
  EXPECT_NE(failure("").find("empty"), std::string::npos);
}

TEST_F(ResourceFiles, RelativeNamesNeedAKnownFolder) {
  const std::string hint = "robot_description needs package:// or file://";
  EXPECT_NE(test::failureOf([&] { loadLocalResource("none/x.stl", find_, ""); }).find(hint), std::string::npos);
  for (const char* uri : {"none/x.stl", "/none/x.stl", "package://arm_description/x.stl"})
    EXPECT_EQ(failure(uri).find(hint), std::string::npos) << failure(uri);
}

TEST_F(ResourceFiles, PipesAreNotReadFrom) {
  ASSERT_EQ(::mkfifo((directory_ / "pipe.stl").c_str(), 0600), 0);
  EXPECT_NE(failure("pipe.stl").find("not a regular file"), std::string::npos);
}

TEST_F(ResourceFiles, UnreadableFileIsNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads everything";
  write("secret.stl", "x");
  ASSERT_EQ(::chmod((directory_ / "secret.stl").c_str(), 0), 0);
  EXPECT_NE(failure("secret.stl").find("cannot be opened"), std::string::npos);
}

}  // namespace sdf_ccd::resource_test
