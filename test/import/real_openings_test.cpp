#include <gtest/gtest.h>

#include "oracle/parameter_name.h"
#include "oracle/test_data.h"
#include "sdf_ccd/mesh.h"
#include "solid/openings/openings.h"

namespace sdf_ccd::real_openings_test {

class RealOpenings : public testing::TestWithParam<const char*> {};

TEST_P(RealOpenings, AreClosed) {
  SDF_CCD_NEEDS_DATA(GetParam());
  const TriangleMesh mesh = orientOutward(loadMesh(test::dataPath(GetParam()))).mesh;
  const Openings openings = findOpenings(mesh);
  EXPECT_TRUE(isClosed(welded(merged(mesh, openings.caps))));
  EXPECT_LT(openings.doubt, 0.05) << summary(openings);
  RecordProperty("openings", summary(openings));
}

INSTANTIATE_TEST_SUITE_P(, RealOpenings,
                         testing::Values("meshes/stanford-bunny.obj", "meshes/teapot.obj",
                                         "meshes/dragon_vrip_res4.ply",
                                         "robots/pr2_description/urdf/meshes/shoulder_v0/shoulder_lift.stl",
                                         "robots/pr2_description/urdf/meshes/torso_v0/torso_lift.stl",
                                         "robots/pr2_description/urdf/meshes/base_v0/base.stl",
                                         "robots/pr2_description/urdf/meshes/gripper_v0/l_finger.stl",
                                         "robots/pr2_description/urdf/meshes/head_v0/head_tilt.stl"),
                         test::ParameterName());

}  // namespace sdf_ccd::real_openings_test
