// The program that reads meshes gets the environment of the one that starts it, a library that sets a locale among it.
#include <gtest/gtest.h>

#include "mesh/content_hash.h"
#include "mesh/reader/dae_file.h"
#include "mesh/reader/octree_file.h"
#include "mesh/reader/parse_mesh.h"
#include "oracle/german_locale.h"
#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"

namespace sdf_ccd::locale_test {

constexpr const char* kDae = R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
 version="1.4.1"><asset><unit meter="0.5"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
 <source id="s"><float_array id="a" count="9">0.25 0 0 1.5 0 0 0 2.5e-1 0</float_array><technique_common>
 <accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
 <param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION"
 source="#s"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
 </mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="vs"><node>
 <translate>0.125 0 0</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#vs"/></scene></COLLADA>)";

TEST(ReaderLocale, AMeshIsTheSameInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  const TriangleMesh box = test::boxMesh({0.25, 0.5, 1.25});
  const std::pair<const char*, std::string> files[] = {
      {"obj", test::obj(box)}, {"off", test::off(box)}, {"ply", test::ply(box)}, {"stl", test::asciiStl(box)}};
  for (const auto& [format, bytes] : files) {
    const TriangleMesh plain = parseMeshUnconfined(bytes, format);
    EXPECT_NEAR(signedVolume(plain), 1.25, 1e-6) << format;
    const test::GermanLocale german;
    EXPECT_TRUE(areIdentical(parseMeshUnconfined(bytes, format), plain)) << format;
  }
  const test::GermanLocale german;
  const TriangleMesh of_dae = parseDae(kDae);
  EXPECT_TRUE(boundingBox(of_dae).isApprox(AlignedBox3d(Vector3d(0.0625, 0, 0), Vector3d(0.8125, 0.125, 0))))
      << boundingBox(of_dae).min().transpose() << " to " << boundingBox(of_dae).max().transpose();
}

TEST(ReaderLocale, AMapIsTheSameInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  const test::GermanLocale german;
  const std::string head = "# Octomap OcTree binary file\nid OcTree\nsize 0\nres 0.025\ndata\n";
  const OctreeFile file = checkOctreeFile(head);
  EXPECT_EQ(file.resolution, 0.025);
  EXPECT_NE(withPlainHead(file, head).find("res 0.025"), std::string::npos) << withPlainHead(file, head);
}

}  // namespace sdf_ccd::locale_test
