#include <ostream>

#include <gtest/gtest.h>

#include "oracle/parameter_name.h"
#include "oracle/test_data.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::real_mesh_quality_test {

struct Expected {
  const char* name;
  int components;
  int boundary_edges;
  bool trusted;
  double volume;
};

std::ostream& operator<<(std::ostream& stream, const Expected& expected) {
  return stream << expected.name;
}

class RealMeshes : public ::testing::TestWithParam<Expected> {};

TEST_P(RealMeshes, AreReportedAsTheyAre) {
  SDF_CCD_NEEDS_DATA(GetParam().name);
  const MeshQuality quality = orientOutward(loadMesh(test::dataPath(GetParam().name))).quality;
  EXPECT_EQ(quality.components, GetParam().components) << summary(quality);
  EXPECT_EQ(quality.boundary_edges, GetParam().boundary_edges) << summary(quality);
  EXPECT_EQ(quality.sign_trusted, GetParam().trusted) << summary(quality);
  EXPECT_NEAR(quality.volume, GetParam().volume, 0.01 * GetParam().volume) << summary(quality);
}

INSTANTIATE_TEST_SUITE_P(
    MeshQuality, RealMeshes,
    ::testing::Values(Expected{"meshes/bunny00.off", 1, 0, true, 0.199},
                      Expected{"meshes/stanford-bunny.obj", 1, 223, false, 7.36e-4},
                      Expected{"meshes/teapot.obj", 4, 160, false, 26.2},
                      Expected{"meshes/cgal_nasty/boeing.off", 1, 0, true, 211},
                      Expected{"meshes/cgal_nasty/elephant-with-holes.off", 1, 1353, false, 0.0383},
                      Expected{"robots/panda_description/meshes/collision/link0.stl", 1, 0, true, 3.0e-3},
                      Expected{"robots/pr2_description/urdf/meshes/base_v0/base.stl", 1, 26, false, 0.0887},
                      Expected{"robots/example-robot-data/robots/ur_description/meshes/ur5/collision/wrist3.stl", 5, 0,
                               true, 1.38e-4}),
    test::ParameterName());

}  // namespace sdf_ccd::real_mesh_quality_test
