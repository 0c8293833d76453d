#include <gtest/gtest.h>

#include "oracle/open_shapes.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {
namespace {

TEST(OpenMeshField, TheOpenBinNeedsAboutAsManyLeavesAsTheClosedOne) {
  FieldOptions options;
  options.max_error = 0.008;
  for (const double half : {0.2, 0.22, 0.25, 0.3, 0.5}) {
    const std::size_t closed = buildField(test::boxMesh(Vector3d::Constant(half)), options).cells();
    const std::size_t open = buildField(test::binMesh(half), options).cells();
    std::printf("half %g closed %zu open %zu\n", half, closed, open);
  }
}

}  // namespace
}  // namespace sdf_ccd
