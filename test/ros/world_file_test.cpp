#include "ros/parameters/world_file.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "oracle/test_data.h"
#include "robot/moveit_scene.h"

namespace sdf_ccd::world_file_test {

std::string written(const std::string& ending, const std::string& text) {
  static const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / ("world" + ending);
  test::writeText(file, text);
  return file.string();
}

std::string errorOf(const std::string& ending, const std::string& text) {
  return test::failureOf<std::exception>([&] { loadWorldFile(written(ending, text)); });
}

template <class Shape>
const Shape& primitiveOf(const WorldObject& object, std::size_t i = 0) {
  return std::get<Shape>(std::get<Primitive>(object.shapes.at(i).shape));
}

/// A scene as MoveIt writes it since Noetic.
const char* const kScene = R"(a scene with a name
* box on the table
0.5 0 0.25
0 0 0.7071068 0.7071068
2
box
0.1 0.2 0.3
0 0 0
0 0 0 1
0 0 0 0
cylinder
0.05 0.4
0 0 0.35
0 0 0 1
0.5 0.5 0.5 1
1
grasp here
0 0 0.1
0 0 0 1
* sheet
0 0 0
0 0 0 1
1
mesh
3 1
0 0 0
1 0 0
0 1 0
0 1 2
0 0 2
0 0 0 1
0 0 0 0
0
.
)";

TEST(WorldFile, MoveitsText) {
  const std::vector<WorldObject> objects = loadWorldFile(written(".scene", kScene));
  ASSERT_EQ(objects.size(), 2u);
  const WorldObject& box = objects[0];
  EXPECT_EQ(box.name, "box on the table");
  EXPECT_EQ(box.frame, "");
  EXPECT_TRUE((box.X_frame_B * Vector3d(1, 0, 0)).isApprox(Vector3d(0.5, 1, 0.25), 1e-6));
  ASSERT_EQ(box.shapes.size(), 2u);
  EXPECT_TRUE(primitiveOf<Box>(box).size.isApprox(Vector3d(0.1, 0.2, 0.3)));
  EXPECT_EQ(primitiveOf<Cylinder>(box, 1).radius, 0.05);
  EXPECT_EQ(primitiveOf<Cylinder>(box, 1).length, 0.4);
  EXPECT_EQ(box.shapes[1].X_BG.translation().z(), 0.35);
  const auto& mesh = *std::get<std::shared_ptr<const TriangleMesh>>(objects[1].shapes.at(0).shape);
  EXPECT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.triangles.at(0), Vector3i(0, 1, 2));
  EXPECT_EQ(objects[1].shapes[0].X_BG.translation().z(), 2.0);
  const std::string nameless = std::string(kScene).substr(std::string(kScene).find('\n'));
  EXPECT_EQ(parseMoveitScene(nameless).size(), 2u) << "MoveIt writes an empty line";
}

TEST(WorldFile, MoveitsTextBeforeNoetic) {
  const std::vector<WorldObject> objects = parseMoveitScene(
      "(noname)+\n* Ball\n1\nsphere\n0.25\n1 2 3\n0 0 0 1\n0 0 0 0\n* wall\n1\nplane\n0 0 2 -1\n0 0 0\n0 0 0 1\n1 0 0 "
      "1\n.\n");
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].name, "Ball");
  EXPECT_TRUE(objects[0].X_frame_B.matrix().isIdentity());
  EXPECT_EQ(primitiveOf<Sphere>(objects[0]).radius, 0.25);
  EXPECT_EQ(objects[0].shapes[0].X_BG.translation(), Vector3d(1, 2, 3));
  EXPECT_EQ(primitiveOf<HalfSpace>(objects[1]).normal, Vector3d(0, 0, 1));
  EXPECT_EQ(primitiveOf<HalfSpace>(objects[1]).offset, 0.5) << "2 z - 1 = 0";
}

TEST(WorldFile, BadTextIsNamedByItsLine) {
  const auto error = [](const std::string& from, const std::string& to) {
    std::string text = kScene;
    text.replace(text.find(from), from.size(), to);
    return errorOf(".scene", text);
  };
  EXPECT_NE(error("box\n0.1", "torus\n0.1").find("line 6: a shape must be box"), std::string::npos);
  EXPECT_NE(error("0.1 0.2", "0.1 -0.2").find("line 7: a size must be positive"), std::string::npos);
  EXPECT_NE(error("0.1 0.2", "0.1 nan").find("line 7: expected a number"), std::string::npos);
  EXPECT_NE(error("0 1 2\n0 0 2", "0 1 3\n0 0 2").find("a triangle has vertex 3, of 3"), std::string::npos);
  EXPECT_NE(error("3 1\n", "900000000 1\n").find("expected an integer from 0 to"), std::string::npos);
  EXPECT_NE(error("3 1\n", "4000000 1\n").find("expected a number"), std::string::npos)
      << "nothing is set aside for it";
  EXPECT_NE(error("0 0 0.7071068 0.7071068", "0 0 0 0").find("line 4: expected a unit quaternion"), std::string::npos);
  EXPECT_NE(error("0.5 0 0.25", "0.5 2e8 0.25").find("line 3: a position more than 1e+08 m"), std::string::npos);
  EXPECT_NE(error("\n.\n", "\n").find("the text ends too early: its last line must be a dot"), std::string::npos);
  EXPECT_NE(errorOf(".scene", "").find("it is empty"), std::string::npos);
  EXPECT_NE(errorOf(".scene", "\n \n").find("the text ends too early"), std::string::npos);
  EXPECT_NE(errorOf(".scene", "name\nbox").find("line 2: expected * and an object's name"), std::string::npos);
  EXPECT_NE(errorOf(".txt", "").find("must end in .yaml, .yml or .scene"), std::string::npos);
  for (std::size_t end = 0; end < std::string(kScene).size() - 2; ++end)
    ASSERT_NE(errorOf(".scene", std::string(kScene).substr(0, end)), "") << end;
}

/// Of quaternions written with two digits the direction counts.
TEST(WorldFile, RoundedQuaternionsAreRotations) {
  std::string text = kScene;
  const std::string exact = "0 0 0.7071068 0.7071068";
  text.replace(text.find(exact), exact.size(), "0 0 0.7 0.7");
  const auto poseIn = [](const std::string& scene) { return loadWorldFile(written(".scene", scene))[0].X_frame_B; };
  EXPECT_TRUE(poseIn(text).isApprox(poseIn(kScene), 1e-6));
}

TEST(WorldFile, ConesAreMeshes) {
  std::string text = kScene;
  const std::string box = "box\n0.1 0.2 0.3\n";
  text.replace(text.find(box), box.size(), "cone\n0.1 0.4\n");
  for (const auto& [suffix, content] :
       {std::pair<const char*, std::string>{".scene", text},
        {".yaml", "world: [{name: a, type: cone, radius: 0.1, length: 0.4}]"},
        {".yaml", "world: {collision_objects: [{id: a, primitives: [{type: cone, dimensions: [0.4, 0.1]}]}]}"}}) {
    const std::vector<WorldObject> objects = loadWorldFile(written(suffix, content));
    const auto& mesh = std::get<std::shared_ptr<const TriangleMesh>>(objects.front().shapes.front().shape);
    EXPECT_NEAR(signedVolume(*mesh), M_PI * 0.01 * 0.4 / 3.0, 1e-5) << content;
  }
}

TEST(WorldFile, OurYamlAndMoveits) {
  const std::vector<WorldObject> ours =
      loadWorldFile(written(".yaml", "world:\n- {name: ball, type: sphere, radius: 0.1, xyz: [1, 2, 3]}\nrate: 5\n"));
  ASSERT_EQ(ours.size(), 1u);
  EXPECT_EQ(primitiveOf<Sphere>(ours[0]).radius, 0.1);

  const std::vector<WorldObject> moveits = loadWorldFile(written(".yml", R"(
world:
  collision_objects:
  - header: {frame_id: base_link, seq: 3}
    id: Can
    type: {key: "", db: ""}
    pose: {position: {x: 1, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 1}}
    primitives: [{type: cylinder, dimensions: [0.4, 0.05]}, {type: 1, dimensions: [1, 2, 3]}]
    primitive_poses:
    - {position: [0, 0, 0.5], orientation: [0, 0, 0, 1]}
    - {position: [0, 1, 0]}
    planes: [{coef: [0, 0, 1, -2]}]
    meshes: [{resource: "package://cell/vice.stl", dimensions: [0.001, 0.001, 0.001]}]
)"));
  ASSERT_EQ(moveits.size(), 1u);
  const WorldObject& can = moveits[0];
  EXPECT_EQ(can.name, "Can");
  EXPECT_EQ(can.frame, "base_link");
  EXPECT_EQ(can.X_frame_B.translation().x(), 1.0);
  ASSERT_EQ(can.shapes.size(), 4u);
  EXPECT_EQ(primitiveOf<Cylinder>(can, 0).radius, 0.05) << "the height stands first";
  EXPECT_EQ(primitiveOf<Cylinder>(can, 0).length, 0.4);
  EXPECT_EQ(can.shapes[0].X_BG.translation().z(), 0.5);
  EXPECT_EQ(primitiveOf<Box>(can, 1).size, Vector3d(1, 2, 3));
  EXPECT_EQ(primitiveOf<HalfSpace>(can, 2).offset, 2.0);
  EXPECT_EQ(std::get<MeshObject>(can.shapes[3].shape).uri, "package://cell/vice.stl");

  EXPECT_NE(errorOf(".yaml", "wrold: []").find("there is no `world`"), std::string::npos);
  EXPECT_NE(errorOf(".yaml", "world: {objects: []}").find("collision_objects is missing"), std::string::npos);
  const auto error = [](const std::string& text) {
    return errorOf(".yaml", "world: {collision_objects: [{id: a, " + text + "}]}");
  };
  EXPECT_NE(error("pose: {position: [2.0e+8, 0, 0]}").find("a position at most 1e+08 m"), std::string::npos);
  EXPECT_NE(errorOf(".yaml", "world: [{name: a, type: sphere, radius: 1, xyz: [0, 0, -2.0e+8]}]")
                .find("xyz is [0, 0, -2e+08], expected a position at most 1e+08 m from the origin"),
            std::string::npos);
  EXPECT_NE(error("primitives: []").find("one or more primitives"), std::string::npos);
  EXPECT_NE(error("primitives: [{type: box, dimensions: [1, 2]}]").find("a list of 3 finite numbers"),
            std::string::npos);
  EXPECT_NE(error("primitives: [{type: torus, dimensions: [1, 2]}]").find("one of box sphere cylinder cone"),
            std::string::npos);
  EXPECT_NE(error("primitives: [{type: 5, dimensions: [1, 2]}]").find("a box, sphere, cylinder or cone"),
            std::string::npos);
  EXPECT_NE(error("operation: 1, primitives: [{type: sphere, dimensions: [1]}]").find("expected ADD"),
            std::string::npos);
  EXPECT_NE(error("primitives: [{type: sphere, dimensions: [1]}], primitive_poses: [{}, {}]").find("expected 1 poses"),
            std::string::npos);
}

TEST(WorldFile, ScenesOfOthers) {
  SDF_CCD_NEEDS_DATA("scenes/motion_bench_maker/configs/scenes/box/scene_box.yaml");
  const std::filesystem::path folder = test::dataPath("scenes/motion_bench_maker/configs/scenes");
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("scene_", 0) != 0) continue;
    std::vector<WorldObject> objects;
    ASSERT_NO_THROW(objects = loadWorldFile(entry.path().string())) << entry.path();
    EXPECT_GT(objects.size(), 0u) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 6);
}

}  // namespace sdf_ccd::world_file_test
