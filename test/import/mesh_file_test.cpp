#include "sdf_ccd/mesh.h"

#include <ostream>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/hostile_files.h"
#include "oracle/mesh_bytes.h"
#include "oracle/parameter_name.h"
#include "oracle/rounds.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"

namespace sdf_ccd::mesh_file_test {

using test::dae;
using test::failureOf;
using test::kDaeInstance;

const TriangleMesh kBox = test::translated(test::boxMesh({1, 2, 3}), {0.25, 0.5, 1});

void expectBox(const TriangleMesh& mesh, const Vector3d& low, const Vector3d& high) {
  const AlignedBox3d box = boundingBox(mesh);
  EXPECT_TRUE(box.min().isApprox(low, 1e-6)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(high, 1e-6)) << box.max().transpose();
}

TEST(MeshFile, EveryFormatGivesTheSameBox) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {test::binaryStl(kBox, "exported"), "a.stl"},
      {test::binaryStl(kBox, "solid part"), "solid.STL"},
      {test::binaryStl(kBox, "solid facet normal"), "facet.stl"},
      {test::binaryStl(kBox, "trailing") + std::string(7, 'x'), "trailing.stl"},
      {test::asciiStl(kBox), "ascii.stl"},
      {"\xEF\xBB\xBF" + test::asciiStl(kBox), "mark.stl"},
      {"\xEF\xBB\xBF" + test::obj(kBox), "mark.obj"},
      {"\xEF\xBB\xBF" + test::off(kBox), "mark.off"},
      {"\xEF\xBB\xBF" + test::ply(kBox), "mark.ply"},
      {test::obj(kBox), "a.obj"},
      {test::off(kBox), "a.off"},
      {test::ply(kBox), "a.ply"},
      {dae(kBox, "<unit meter=\"1\"/><up_axis>Z_UP</up_axis>", std::string("<node>") + kDaeInstance + "</node>"),
       "package://robot/meshes/a.dae"}};
  for (const auto& [bytes, name] : files) {
    const TriangleMesh mesh = parseMesh(bytes, name);
    EXPECT_EQ(mesh.vertices.size(), 8u) << name;
    EXPECT_EQ(mesh.triangles.size(), 12u) << name;
    EXPECT_NEAR(signedVolume(mesh), 48, 1e-5) << name;
    expectBox(mesh, {-0.75, -1.5, -2}, {1.25, 2.5, 4});
  }
}

TEST(MeshFile, DaeUnitIsAppliedAndUpAxisIsNot) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const std::string asset = std::string("<unit name=\"centimeter\" meter=\"0.01\"/><up_axis>") + up + "</up_axis>";
    expectBox(parseMesh(dae(kBox, asset, std::string("<node>") + kDaeInstance + "</node>"), "a.dae"),
              {-0.0075, -0.015, -0.02}, {0.0125, 0.025, 0.04});
  }
  expectBox(parseMesh(dae(kBox, "", std::string("<node>") + kDaeInstance + "</node>"), "a.dae"), {-0.75, -1.5, -2},
            {1.25, 2.5, 4});
}

TEST(MeshFile, DaeNodesAreAppliedAndScaledByTheUnit) {
  const std::string node = std::string("<node><translate>10 0 0</translate><node><rotate>0 0 1 90</rotate>") +
                           kDaeInstance + "</node></node>";
  const TriangleMesh mesh = parseMesh(dae(kBox, "<unit meter=\"0.1\"/><up_axis>Y_UP</up_axis>", node), "a.dae");
  expectBox(mesh, {1 - 0.25, -0.075, -0.2}, {1 + 0.15, 0.125, 0.4});
}

TEST(MeshFile, MirroredAndRepeatedInstancesKeepTheOutsideOutside) {
  const std::string node = std::string("<node>") + kDaeInstance + "</node><node><translate>20 0 0</translate>" +
                           "<scale>1 -2 1</scale>" + kDaeInstance + "</node>";
  const TriangleMesh mesh = parseMesh(dae(kBox, "<unit meter=\"1\"/>", node), "a.dae");
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_NEAR(signedVolume(mesh), 48 + 96, 1e-4);
  const MeshQuality quality = orientOutward(mesh).quality;
  EXPECT_EQ(quality.inverted_components, 0);
  EXPECT_TRUE(quality.sign_trusted);
}

TEST(MeshFile, PolygonsAreTriangulated) {
  const std::string cube =
      "OFF\n8 6 0\n-1 -1 -1\n1 -1 -1\n-1 1 -1\n1 1 -1\n-1 -1 1\n1 -1 1\n-1 1 1\n1 1 1\n"
      "4 0 4 6 2\n4 1 3 7 5\n4 0 1 5 4\n4 2 6 7 3\n4 0 2 3 1\n4 4 5 7 6\n";
  EXPECT_NEAR(signedVolume(parseMesh(cube, "cube.off")), 8, 1e-6);
  EXPECT_EQ(parseMesh(cube, "cube.off").triangles.size(), 12u);
}

TEST(MeshFile, ErrorsNameTheFileAndTheReason) {
  const std::string stl = test::binaryStl(kBox, "binary");
  const auto error = [](const std::string& bytes, const std::string& name) {
    return failureOf([&] { parseMesh(bytes, name); });
  };
  EXPECT_EQ(error("", "link.stl"), "link.stl: empty");
  EXPECT_EQ(error(stl, "link"), "link: the file name has no extension, so the format is unknown");
  EXPECT_EQ(error(stl.substr(0, 400), "link.stl"), "link.stl: truncated: 12 triangles need 684 bytes, there are 400");
  EXPECT_NE(error(stl.substr(0, 60), "link.stl").find("truncated"), std::string::npos);
  EXPECT_EQ(error(test::binaryStl({}, "none"), "link.stl").rfind("link.stl: ", 0), 0u);
  EXPECT_EQ(error("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n", "link.stl"),
            "link.stl: it is text, but no STL; it begins with \"version https://git-lfs.github.com/spec/v1\"");
  EXPECT_EQ(error("solid part\nendsolid part\n", "link.stl"), "link.stl: the mesh has no triangle");
  EXPECT_NE(error("not a mesh", "link.xyz"), "");
  EXPECT_NE(error("<COLLADA", "link.dae"), "");
  EXPECT_NE(error(dae(kBox, "<unit meter=\"-1\"/>", std::string("<node>") + kDaeInstance + "</node>"), "a.dae")
                .find("unit meter=\"-1\""),
            std::string::npos);
  EXPECT_NE(error(dae(kBox, "", "<node/>"), "a.dae"), "");
  EXPECT_EQ(failureOf([] { loadMesh("/nonexistent/link.stl"); }),
            "/nonexistent/link.stl: cannot be opened: No such file or directory");
  EXPECT_NE(failureOf([] { loadMesh("/"); }), "");

  TriangleMesh bad = kBox;
  bad.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error(test::binaryStl(bad, "nan"), "nan.stl").find("not finite"), std::string::npos);
  bad.vertices[3].x() = 1e30;
  EXPECT_NE(error(test::binaryStl(bad, "far"), "far.stl").find("too large or too far from the origin: extent 1e+30 m"),
            std::string::npos);
  bad = kBox;
  bad.triangles[5][2] = 900;
  EXPECT_NE(error(test::obj(bad), "bad.obj"), "");
}

TEST(MeshFile, AnnouncingMoreThanThereIsCostsNoMemory) {
  std::string stl = test::binaryStl(kBox, "lies");
  stl[80] = stl[81] = stl[82] = stl[83] = '\xff';
  EXPECT_NE(failureOf([&] { parseMesh(stl, "lies.stl"); }).find("4294967295 triangles"), std::string::npos);
}

TEST(MeshFile, CountsAndReferencesThatLieAreRefused) {
  const std::string good = dae(kBox, "<unit meter=\"1\"/>", std::string("<node>") + kDaeInstance + "</node>");
  const auto damaged = [](std::string bytes, const std::string& from, const std::string& to) {
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  const auto error = [](const std::string& bytes, const std::string& name) {
    return failureOf([&] { parseMesh(bytes, name); });
  };
  EXPECT_NE(error(damaged(good, "<p>0 4 6", "<p>0 q 6"), "a.dae").find("<p>"), std::string::npos);
  EXPECT_NE(error(damaged(good, "count=\"24\"", "count=\"21\""), "a.dae").find("reads beyond"), std::string::npos);
  EXPECT_NE(error(damaged(good, "stride=\"3\"", "stride=\"1\""), "a.dae").find("reads beyond"), std::string::npos);
  const std::string cycle = "<node id=\"n\"><node id=\"m\"><instance_node url=\"#n\"/></node></node>";
  EXPECT_NE(error(dae(kBox, "", cycle), "a.dae"), "");
  EXPECT_NE(error(test::ply(kBox).substr(0, test::ply(kBox).find("element face")), "a.ply").find("no end_header"),
            std::string::npos);
  EXPECT_NE(error(damaged(test::ply(kBox), "face 12", "face 4000000000"), "a.ply").find("is not a valid count"),
            std::string::npos);
  EXPECT_NE(error(damaged(test::ply(kBox), "element face", "elephant face"), "a.ply").find("unknown line"),
            std::string::npos);
  EXPECT_NE(error(damaged(test::off(kBox), "8 12", "8 4000000000"), "a.off").find("is not a valid count"),
            std::string::npos);
}

TEST(MeshFile, TruncatedTextIsRefusedWhereverItEnds) {
  for (const auto& [bytes, name] : {std::pair(test::off(kBox), "a.off"), std::pair(test::ply(kBox), "a.ply")}) {
    EXPECT_EQ(parseMesh(bytes, name).triangles.size(), 12u);
    EXPECT_EQ(parseMesh(bytes.substr(0, bytes.size() - 1), name).triangles.size(), 12u);  // without the last newline
    for (std::size_t length = 0; length + 2 < bytes.size(); ++length) {
      EXPECT_THROW(parseMesh(bytes.substr(0, length), name), std::runtime_error) << name << " cut to " << length;
    }
  }
  const std::string off = test::off(kBox);
  EXPECT_EQ(failureOf([&] { parseMesh(off.substr(0, off.size() - 4), "a.off"); }),
            "a.off: truncated or damaged: 12 of element face are announced, 11 are whole");
  // Comments, blank lines and colours are skipped; a list of a PLY file may span several lines.
  const std::string odd = "OFF # made by hand\n\n3 1 0\n# corners\n0 0 0\n1 0 0 # right\n\n0 1 0\n3 0 1 2 255 0 0\n";
  EXPECT_EQ(parseMesh(odd, "odd.off").triangles.size(), 1u);
}

TEST(MeshFile, ConcavePolygonsAreFilledRightly) {
  // An L-shaped prism whose caps are concave hexagons; a triangle fan about the first corner would fill the notch.
  const std::string prism =
      "OFF\n12 8 0\n1 2 0\n0 2 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 1\n0 2 1\n0 0 1\n2 0 1\n2 1 1\n1 1 1\n"
      "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n";
  const MeshQuality quality = orientOutward(parseMesh(prism, "prism.off")).quality;
  EXPECT_NEAR(quality.volume, 3, 1e-6);
  EXPECT_NEAR(quality.area, 2 * 3 + 8, 1e-6);
  EXPECT_TRUE(quality.sign_trusted);
}

TEST(MeshFile, DamagedFilesThrowOrGiveAValidMesh) {
  std::mt19937_64 random(1);
  const std::vector<std::pair<std::string, std::string>> files = {
      {test::binaryStl(kBox, "binary"), "a.stl"},
      {test::asciiStl(kBox), "b.stl"},
      {test::obj(kBox), "a.obj"},
      {test::off(kBox), "a.off"},
      {test::ply(kBox), "a.ply"},
      {dae(kBox, "<unit meter=\"1\"/>", std::string("<node>") + kDaeInstance + "</node>"), "a.dae"}};
  int read = 0, refused = 0;
  for (const auto& [bytes, name] : files) {
    for (int round = 0; round < test::rounds(150); ++round) {
      std::string damaged = bytes.substr(0, round % 3 == 0 ? random() % bytes.size() : bytes.size());
      for (std::size_t hit = 0; hit < random() % 4 && !damaged.empty(); ++hit) {
        damaged[random() % damaged.size()] = static_cast<char>(random());
      }
      try {
        const TriangleMesh mesh = parseMesh(damaged, name);
        ++read;
        EXPECT_NO_THROW(validate(mesh));
      } catch (const std::runtime_error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(read, test::rounds(100));
  EXPECT_GT(refused, test::rounds(100));
}

TEST(MeshFile, HostileFilesAreRefusedAndTheirNeighbourIsRead) {
  for (const std::string& name : test::hostileMeshes()) {
    const std::string path = test::hostilePath(name);
    EXPECT_EQ(failureOf([&] { loadMesh(path); }).rfind(path + ": ", 0), 0u) << name;
  }
  const MeshQuality quality = orientOutward(loadMesh(test::hostilePath("prism_12.off"))).quality;
  EXPECT_NEAR(quality.volume, 3.0, 0.2);  // its corners are not exactly those of a regular prism
  EXPECT_EQ(quality.boundary_edges, 0);
}

struct RobotMesh {
  const char* name;
  std::size_t triangles;
  double longest_side;
};

std::ostream& operator<<(std::ostream& stream, const RobotMesh& mesh) {
  return stream << mesh.name;
}

class RobotMeshes : public ::testing::TestWithParam<RobotMesh> {};

TEST_P(RobotMeshes, Load) {
  const std::string name = std::string("robots/") + GetParam().name;
  SDF_CCD_NEEDS_DATA(name);
  const TriangleMesh mesh = loadMesh(test::dataPath(name));
  EXPECT_EQ(mesh.triangles.size(), GetParam().triangles);
  EXPECT_NEAR(boundingBox(mesh).sizes().maxCoeff(), GetParam().longest_side, 0.005 * GetParam().longest_side);
}

INSTANTIATE_TEST_SUITE_P(
    MeshFile, RobotMeshes,
    ::testing::Values(RobotMesh{"pr2_description/urdf/meshes/torso_v0/torso.stl", 2092, 0.801},  // begins with solid
                      RobotMesh{"pr2_description/urdf/meshes/gripper_v0/finger_tip_r.stl", 888, 0.0567},
                      RobotMesh{"panda_description/meshes/collision/link5.stl", 300, 0.317},
                      RobotMesh{"panda_description/meshes/visual/link5.dae", 18327, 0.311},    // with lines and points
                      RobotMesh{"pr2_description/urdf/meshes/base_v0/base.dae", 1200, 0.669},  // Y_UP
                      RobotMesh{"pr2_description/kinect.dae", 6752, 0.00276},  // in centimetres, and scaled by 0.001
                      RobotMesh{"example-robot-data/robots/allegro_hand_description/meshes/base_link.STL", 3276,
                                0.113}),
    test::ParameterName());

}  // namespace sdf_ccd::mesh_file_test
