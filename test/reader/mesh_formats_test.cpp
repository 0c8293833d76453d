// Features of the formats that test/import/mesh_file_test.cpp does not cover.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/reader/parse_mesh.h"
#include "oracle/failure.h"
#include "oracle/hostile_files.h"
#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::mesh_formats_test {

constexpr double kVolume = 48.0;

TriangleMesh readDae(const std::string& bytes) {
  return parseMesh(bytes, "a.dae");
}

TEST(MeshFormats, PolygonsOfAnyNumberOfCorners) {
  for (const int corners : {10, 12, 2000}) {
    std::string off = "OFF\n" + std::to_string(2 * corners) + " " + std::to_string(corners + 2) + " 0\n", low, high,
                sides;
    for (int level = 0; level < 2; ++level) {
      for (int i = 0; i < corners; ++i) {
        const double angle = 2 * M_PI * i / corners;
        off += std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " + std::to_string(level) +
               "\n";
      }
    }
    for (int i = 0; i < corners; ++i) {
      const int j = (i + 1) % corners;
      low = " " + std::to_string(i) + low;
      high += " " + std::to_string(corners + i);
      sides += "4 " + std::to_string(i) + " " + std::to_string(j) + " " + std::to_string(corners + j) + " " +
               std::to_string(corners + i) + "\n";
    }
    const std::string count = std::to_string(corners);
    const TriangleMesh mesh = parseMeshUnconfined(off + count + low + "\n" + count + high + "\n" + sides, "off");
    EXPECT_NEAR(signedVolume(mesh), 0.5 * corners * std::sin(2 * M_PI / corners), 1e-5) << corners;
    EXPECT_EQ(mesh.triangles.size(), 4u * static_cast<unsigned>(corners) - 4);
  }
}

TEST(MeshFormats, ObjWithAllThatItAllows) {
  const std::string vertices =
      "# box\r\nmtllib /dev/zero\r\nv -1 -1 -1\r\nv 1 -1 -1 1.0\r\nv 2 2 -2 2\r\nv -1 1 -1 0.1 0.2 0.3\r\n";
  const std::string more = "o top\n# C:\\models\\\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvn 0 0 1\nvt 0 0\n";
  const std::string faces =
      "f 4/1/1 3/1 2//1 1\nf -4 -3 \\\n -2 -1\nf 1 2 6 5 # front\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nl 1 2\np 1\n";
  EXPECT_NEAR(signedVolume(parseMeshUnconfined(vertices + more + faces, "obj")), 8.0, 1e-9);
}

TEST(MeshFormats, PlyInEitherByteOrderWithOtherElementsBetween) {
  const TriangleMesh box = test::boxMesh({1, 2, 3});
  for (const bool is_big : {false, true}) {
    EXPECT_NEAR(signedVolume(parseMeshUnconfined(test::binaryPly(box, is_big), "ply")), kVolume, 1e-9);
  }
}

/// An OFF file of the unit cube, each face of which has corners of its own, moved by up to `noise` and by `offset`.
std::string cubeOfFaces(const Vector3d& offset, double noise) {
  const TriangleMesh cube = test::boxMesh(Vector3d::Constant(0.5));
  std::string text = "OFF\n" + std::to_string(3 * cube.triangles.size()) + " 12 0\n", faces;
  int corners = 0;
  for (const Vector3i& t : cube.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d p = cube.vertices[t[k]] + offset + noise * Vector3d(corners % 2, corners % 3, corners % 5);
      text += fmt::format("{:.17g} {:.17g} {:.17g}\n", p.x(), p.y(), p.z());
      faces += (k == 0 ? "3 " : " ") + std::to_string(corners++);
    }
    faces += "\n";
  }
  return text + faces;
}

TEST(MeshFormats, CornersThatDifferInTheirLastDigitsAreWelded) {
  const TriangleMesh mesh = parseMeshUnconfined(cubeOfFaces(Vector3d::Constant(0.3), 1e-12), "off");
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_TRUE(isClosed(mesh));
}

TEST(MeshFormats, CoordinatesKeepAllDigitsFarFromTheOrigin) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d offset = 4.5e6 * Vector3d::Unit(axis);
    const TriangleMesh mesh = parseMeshUnconfined(cubeOfFaces(offset, 0.0), "off");
    const AlignedBox3d box = boundingBox(mesh);
    EXPECT_EQ(box.min(), Vector3d(offset - Vector3d::Constant(0.5))) << axis;
    EXPECT_EQ(box.max(), Vector3d(offset + Vector3d::Constant(0.5))) << axis;
    EXPECT_TRUE(isClosed(mesh));
  }
}

TEST(MeshFormats, WhatIsFarAwayFlattensNothing) {
  const std::string plate =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0.002\nv 1 0 0.002\nv 1 1 0.002\nv 0 1 0.002\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  EXPECT_EQ(parseMeshUnconfined(plate + "v 1e9 0 0\n", "obj").vertices.size(), 8u) << "a vertex of no face";
  const std::string far = "v 1e5 0 0\nv 1e5 1 0\nv 1e5 0 1\nf 9 10 11\n";
  EXPECT_EQ(parseMeshUnconfined(plate + far, "obj").vertices.size(), 11u);
}

TEST(MeshFormats, PlyStrips) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
      "property double z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const TriangleMesh mesh = parseMeshUnconfined(head + "0 0 0 1 0 0 0 1 0 1 1 0 2 2 0\n8 0 1 2 3 -1 1 4 3\n", "ply");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_GT(areaNormal(mesh, i).z(), 0.0) << i;
}

TEST(MeshFormats, PlyVerticesNeedAllCoordinates) {
  const std::string good = test::ply(test::boxMesh({1, 2, 3}));
  for (const char* name : {"x", "y", "z"}) {
    std::string bytes = good;
    const std::string property = std::string("property float ") + name;
    bytes.replace(bytes.find(property), property.size(), "property float nx");
    EXPECT_NE(test::failureOf([&] { parseMeshUnconfined(bytes, "ply"); }).find(std::string("no property ") + name),
              std::string::npos);
  }
}

TEST(MeshFormats, OffWithColoursAndNormals) {
  const std::string faces = "3 0 2 1 255 0 0\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  for (const char* head : {"COFF\n", "NOFF ", "STCNOFF # all\n", ""}) {
    const std::string bytes = std::string(head) + "4 4 6\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n0 0 1 1 1 1\n" + faces;
    EXPECT_NEAR(signedVolume(parseMeshUnconfined(bytes, "off")), 1.0 / 6.0, 1e-9) << head;
  }
  for (const char* head : {"4OFF\n", "nOFF 3\n", "OFF BINARY\n", "PLY\n"}) {
    EXPECT_THROW(parseMeshUnconfined(std::string(head) + "4 4 6\n" + faces, "off"), std::runtime_error) << head;
  }
}

TEST(MeshFormats, AsciiStlOfSeveralSolids) {
  std::string solid = "solid a name with vertex and facet\n" + test::asciiStl(test::boxMesh({1, 2, 3})).substr(11);
  EXPECT_NEAR(signedVolume(parseMeshUnconfined(solid + test::asciiStl(test::boxMesh({1, 1, 1})), "stl")), kVolume + 8.0,
              1e-9);
  EXPECT_THROW(parseMeshUnconfined(solid.substr(0, solid.rfind("endsolid")), "stl"), std::runtime_error);
}

TEST(MeshFormats, DaeTransformsThatAreNotAffineAreRefused) {
  const auto with = [](const std::string& transform) {
    return readDae(test::dae(test::boxMesh({1, 2, 3}), "", "<node>" + transform + test::kDaeInstance + "</node>"));
  };
  // Looks along -z with y up: only moved.
  EXPECT_TRUE(boundingBox(with("<lookat>4 5 6 4 5 0 0 1 0</lookat>")).center().isApprox(Vector3d(4, 5, 6), 1e-12));
  for (const char* degenerate : {"4 5 6 4 5 6 0 1 0", "4 5 6 4 0 6 0 1 0", "4 5 6 4 5 0 0 0 0"}) {
    EXPECT_THROW(with(std::string("<lookat>") + degenerate + "</lookat>"), std::runtime_error) << degenerate;
  }
  for (const char* last : {"0 0 0.1 1", "1 0 0 1", "0 0 0 2", "0 0 0 0"}) {
    const std::string matrix = std::string("<matrix>1 0 0 0 0 1 0 0 0 0 1 0 ") + last + "</matrix>";
    EXPECT_NE(test::failureOf([&] { with(matrix); }).find("projective"), std::string::npos) << last;
  }
}

TEST(MeshFormats, DaePolygonsAndTransforms) {
  const std::string triangles = test::dae(test::boxMesh({1, 2, 3}), "",
                                          std::string("<node><matrix>0 -1 0 7 1 0 0 0 0 0 1 0 0 0 0 1</matrix>"
                                                      "<scale>1 1 2</scale>") +
                                              test::kDaeInstance + "</node>");
  const TriangleMesh turned = readDae(triangles);
  EXPECT_NEAR(signedVolume(turned), 2 * kVolume, 1e-9);
  EXPECT_TRUE(boundingBox(turned).min().isApprox(Vector3d(5, -1, -6), 1e-12)) << boundingBox(turned).min().transpose();

  const auto with = [&](const std::string& primitive) {
    const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
    std::string bytes = test::dae(square, "", std::string("<node>") + test::kDaeInstance + "</node>");
    const std::size_t begin = bytes.find("<triangles"), end = bytes.find("</triangles>") + 12;
    return bytes.replace(begin, end - begin, primitive);
  };
  const std::string input =
      "<input semantic=\"NORMAL\" source=\"#p\" offset=\"1\"/>"
      "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
  const std::string corners = "<p>0 0 1 0 2 0 3 0</p>";
  for (const std::string& primitive :
       {"<polylist count=\"1\">" + input + "<vcount>4</vcount>" + corners + "</polylist>",
        "<polygons count=\"1\">" + input + corners + "</polygons>",
        "<tristrips count=\"1\">" + input + "<p>0 0 1 0 3 0 2 0</p></tristrips>"}) {
    const TriangleMesh mesh = readDae(with(primitive));
    EXPECT_NEAR(surfaceArea(mesh), 1.0, 1e-12) << primitive;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) EXPECT_GT(areaNormal(mesh, static_cast<int>(i)).z(), 0.0);
  }
  // assimp would leave these out, or read them as others, and say nothing.
  for (const std::string& primitive :
       {"<polylist count=\"1\">" + input + "<vcount>5</vcount>" + corners + "</polylist>",
        "<trifans count=\"1\">" + input + corners + "</trifans>",
        "<polygons count=\"1\">" + input + "<ph>" + corners + "<h>0 0 1 0 2 0</h></ph></polygons>",
        "<triangles count=\"1\">" + input + "<p>0 0 -1 0 2 0</p></triangles>",
        "<triangles>" + input + "<p>0 0 1 0 2 0</p></triangles>"}) {
    EXPECT_THROW(readDae(with(primitive)), std::runtime_error) << primitive;
  }
}

TEST(MeshFormats, DaePartsThatAreMissingAreRefused) {
  const TriangleMesh box = test::boxMesh({1, 2, 3});
  const std::string good = std::string("<node>") + test::kDaeInstance + "</node>";
  for (const char* part :
       {"<node><instance_geometry url=\"#other\"/></node>", "<node><instance_geometry url=\"other.dae#g\"/></node>",
        "<node><instance_node url=\"other.dae#n\"/></node>", "<node><instance_node/></node>",
        "<node id=\"m\"><instance_geometry url=\"#m\"/></node>", "<node><instance_controller url=\"#other\"/></node>",
        "<node><rotate>1 0 1 90</rotate><instance_geometry url=\"#g\"/></node>",
        "<node><rotate>0 0 1</rotate><instance_geometry url=\"#g\"/></node>",
        "<node><skew>45 1 0 0 0 1 0</skew><instance_geometry url=\"#g\"/></node>"}) {
    EXPECT_NE(test::failureOf([&] { readDae(test::dae(box, "", good + part)); }).find("<"), std::string::npos) << part;
  }
  const std::string bytes = test::dae(box, "", good);
  const std::string third = "<param name=\"Z\"";
  EXPECT_THROW(readDae(std::string(bytes).replace(bytes.find(third), third.size(), "<param name=\"W\"")),
               std::runtime_error);
  for (std::size_t length = bytes.find("</p>"); length < bytes.size(); length += 60) {
    EXPECT_THROW(readDae(bytes.substr(0, length)), std::runtime_error) << length;
  }
}

TEST(MeshFormats, WhereFloatsLoseAMeshItIsRefused) {
  TriangleMesh box = test::boxMesh({0.5, 0.5, 0.5});
  const auto at = [&](double x) {
    TriangleMesh moved = box;
    for (Vector3d& p : moved.vertices) p.x() += x;
    return test::dae(moved, "", std::string("<node>") + test::kDaeInstance + "</node>");
  };
  EXPECT_NEAR(signedVolume(readDae(at(1000.0))), 1.0, 1e-3);
  EXPECT_NE(test::failureOf([&] { readDae(at(4.5e6)); }).find("too far"), std::string::npos);
}

TEST(MeshFormats, PlyTextIsReadOnlyIfEveryNumberIsThere) {
  const std::string good = test::ply(test::boxMesh({1, 2, 3}));
  const auto damaged = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  for (const std::string& bytes :
       {damaged("3 0 ", "3 x "), damaged("3 0 ", "3 0.5 "), damaged("end_header\n-1 ", "end_header\n"),
        damaged("property float x", "property half x"), damaged("ascii", "text")}) {
    EXPECT_THROW(parseMeshUnconfined(bytes, "ply"), std::runtime_error) << bytes;
  }
}

}  // namespace sdf_ccd::mesh_formats_test
