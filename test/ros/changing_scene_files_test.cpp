#include <fcntl.h>
#include <stdio.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"
#include "ros/changing_scene_case.h"

namespace sdf_ccd::changing_scene_files_test {

using namespace test;

class ChangingSceneFilesTest : public ChangingSceneCase {
 protected:
  static SceneChange posed(const std::string& name) {
    SceneChange made = change(SceneChange::ADD, name);
    made.pose.orientation.w = 1.0;
    return made;
  }
};

TEST_F(ChangingSceneFilesTest, TrianglesOfMeshFilesCountAgainstTheLimit) {
  test::writeText(folder_ / "ball.off", test::off(test::icosphere(0.1, 1)));  // 80 triangles
  SceneChange ball = posed("ball");
  ball.mesh_resources = {(folder_ / "ball.off").string()};
  limits_.triangles = 160;
  SceneChange other = ball;
  other.id = "other";
  apply({ball, other});
  limits_.triangles = 159;
  const std::string refused = failureOf<std::exception>([&] { apply({ball, other}); });
  EXPECT_NE(refused.find("more triangles than one call may hold"), std::string::npos) << refused;
}

TEST_F(ChangingSceneFilesTest, NamesWithBlanksAtTheirEndsAreNeitherTakenNorSaved) {
  for (const char* name : {" a", "a ", " "}) {
    EXPECT_EQ(refusal(box(name)).find("object '" + std::string(name) + "': a name must not be empty, begin or end"),
              0u);
    SceneChange attach = box(name);
    attach.operation = SceneChange::ATTACH;
    attach.link_name = "tool";
    EXPECT_NE(refusal(attach), "") << name;
  }
  EXPECT_EQ(refusal(box("a b")), "");
  // A world file may have named it so; when read back, it would be another object.
  BodyDescription trailing = body("a b");
  trailing.name = "a ";
  scene_->add(trailing);
  std::vector<std::string> warnings;
  EXPECT_NE(test::failureOf<std::invalid_argument>([&] { sceneText(*scene_, history_, warnings); }).find("'a '"),
            std::string::npos);
}

TEST_F(ChangingSceneFilesTest, ReadsNoFilesButThoseBelowTheRoots) {
  SceneChange bad = posed("box");
  for (const std::string& uri : {std::string("file:///etc/passwd"), std::string("/etc/passwd"),
                                 folder_.string() + "/../passwd", std::string("mesh.stl")}) {
    bad.mesh_resources = {uri};
    EXPECT_NE(refusal(bad).find("resource_roots"), std::string::npos) << refusal(bad);
  }
  std::filesystem::create_symlink("/etc", folder_ / "link");
  bad.mesh_resources = {(folder_ / "link/passwd").string()};
  EXPECT_NE(refusal(bad).find("resource_roots"), std::string::npos);
  bad = change(SceneChange::LOAD, "");
  bad.file = "/etc/world.yaml";
  EXPECT_NE(refusal(bad).find("resource_roots"), std::string::npos);
  std::ofstream(folder_ / "tetra.off")
      << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  SceneChange good = posed("box");
  good.mesh_resources = {"file://" + (folder_ / "tetra.off").string()};
  EXPECT_EQ(refusal(good), "");
}

/// What is found under another spelling than the request's must be below the roots too.
TEST_F(ChangingSceneFilesTest, NoSpellingLeadsOutOfTheRoots) {
  const test::TemporaryDirectory elsewhere;
  const std::filesystem::path secret = elsewhere / "secret.off";
  test::writeText(secret, test::off(test::icosphere(0.1, 1)));
  std::filesystem::create_symlink(secret, folder_ / "link.off");
  const std::string out = "%2e%2e/" + elsewhere.string().substr(folder_.string().rfind('/') + 1) + "/secret.off";
  std::string escaped = out;
  escaped.replace(escaped.find("/"), 1, "%2f");
  SceneChange bad = posed("box");
  for (const std::string& name : {out, escaped, std::string("LINK.off"), std::string("l%69nk.off")}) {
    for (const char* scheme : {"", "file://"}) {
      bad.mesh_resources = {scheme + (folder_ / name).string()};
      EXPECT_NE(refusal(bad).find("resource_roots"), std::string::npos) << name << ": " << refusal(bad);
    }
  }
  test::writeText(folder_ / "in side.off", test::off(test::icosphere(0.1, 1)));
  bad.mesh_resources = {"file://" + (folder_ / "IN%20side.off").string()};
  EXPECT_EQ(refusal(bad), "");
}

/// Swaps a folder of the root for a link that leads out of it, over and over.
class SwappedFolder {
 public:
  SwappedFolder(const std::filesystem::path& root, const std::filesystem::path& outside)
      : folder_((root / "d").string()), link_((root / "e").string()) {
    std::filesystem::create_directory(folder_);
    std::filesystem::create_symlink(outside, link_);
    thread_ = std::thread([this] {
      while (!ends_) ::renameat2(AT_FDCWD, folder_.c_str(), AT_FDCWD, link_.c_str(), RENAME_EXCHANGE);
    });
  }
  ~SwappedFolder() {
    ends_ = true;
    thread_.join();
  }

 private:
  std::string folder_, link_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

TEST_F(ChangingSceneFilesTest, NoLinkThatIsSwappedMeanwhileLeadsOutOfTheRoots) {
  const test::TemporaryDirectory outside;
  test::writeText(outside / "secret.off", "secret");
  const SwappedFolder swapped(folder_.path(), outside.path());
  const std::string saved = (folder_ / "d/x.scene").string(), secret = (folder_ / "d/secret.off").string();
  int written = 0, refused = 0, leaked = 0, outside_count = 0;
  for (int i = 0; i < 3000; ++i) {
    try {
      files_->write(saved, "a world");
      ++written;
    } catch (const std::runtime_error&) {
      ++refused;
    }
    outside_count += std::filesystem::remove(outside / "x.scene");
    try {
      leaked += files_->resource(secret).bytes == "secret";
      leaked += files_->read(secret).bytes == "secret";
    } catch (const std::runtime_error&) {
    }
  }
  EXPECT_EQ(outside_count, 0);
  EXPECT_EQ(leaked, 0);
  EXPECT_GT(written, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(ChangingSceneFilesTest, AWorldIsWrittenWholeOrNotAtAll) {
  const std::filesystem::path file = folder_ / "w.scene";
  files_->write(file.string(), "first");
  files_->write("file://" + file.string(), "second");
  EXPECT_EQ(test::readText(file), "second");
  std::filesystem::create_directory(folder_ / "folder.scene");
  EXPECT_THROW(files_->write((folder_ / "folder.scene").string(), "text"), std::runtime_error);
  EXPECT_THROW(files_->write((folder_ / "absent/w.scene").string(), "text"), std::runtime_error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 2);
}

TEST_F(ChangingSceneFilesTest, ARootMayComeLater) {
  const std::filesystem::path later = folder_ / "later";
  const RequestFiles files({later.string()}, [](const std::string&) { return Resource(); });
  const std::string file = (later / "a.off").string();
  EXPECT_THROW(files.path(file), std::runtime_error);
  std::filesystem::create_directory(later);
  EXPECT_EQ(files.path(file), std::filesystem::canonical(later).string() + "/a.off");
}

TEST_F(ChangingSceneFilesTest, WhatIsWrittenIsReadAgain) {
  SceneChange all = box("all");
  all.primitives.resize(3);
  all.primitives[1].type = shape_msgs::SolidPrimitive::SPHERE;
  all.primitives[1].dimensions = {0.1};
  all.primitives[2].type = shape_msgs::SolidPrimitive::CYLINDER;
  all.primitives[2].dimensions = {0.5, 0.1};
  all.planes.resize(1);
  all.planes[0].coef = {{0, 0, 2, 1}};
  all.meshes.resize(1);
  all.meshes[0].vertices.resize(3);
  all.meshes[0].vertices[1].x = all.meshes[0].vertices[2].y = 1.0 / 3.0;
  all.meshes[0].triangles.resize(1);
  all.meshes[0].triangles[0].vertex_indices = {{0, 1, 2}};
  all.header.frame_id = "belt";
  apply(all);
  std::vector<std::string> warnings;
  std::ofstream(folder_ / "world.scene") << sceneText(*scene_, history_, warnings);
  SceneChange load = change(SceneChange::LOAD, "");
  load.file = (folder_ / "world.scene").string();
  const BodyDescription before = body("all");
  apply({change(SceneChange::REMOVE, "*"), load});
  const BodyDescription after = body("all");
  EXPECT_EQ(after.frame, "base");
  EXPECT_NEAR((after.X_frame_B.translation() - Vector3d(10, 0, 0)).norm(), 0.0, 1e-12);
  ASSERT_EQ(after.geometry.size(), before.geometry.size());
  for (std::size_t i = 0; i < after.geometry.size(); ++i)
    ASSERT_EQ(after.geometry[i].shape.index(), before.geometry[i].shape.index());
  const auto& plane = std::get<HalfSpace>(std::get<Primitive>(after.geometry[3].shape));
  EXPECT_EQ(plane.offset, -0.5);
  const auto& mesh = *std::get<std::shared_ptr<const TriangleMesh>>(after.geometry[4].shape);
  EXPECT_EQ(mesh.vertices[1].x(), 1.0 / 3.0);
  EXPECT_EQ(objects(), (std::vector<std::string>{"all", "table"}));
}

}  // namespace sdf_ccd::changing_scene_files_test
