#include "field/cell_reader.h"

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::cell_reader_test {

using namespace test;

/// Random walks of short steps lead from cell to cell, from far bricks into sampled ones and out of the grid.
TEST(CellReader, SaysBitByBitWhatTheFieldSays) {
  const Vector3d half(0.3, 0.2, 0.1);
  FieldOptions uniform, adaptive;
  uniform.cells = 40;
  adaptive.max_error = 0.002;
  adaptive.cells.reset();
  for (const DistanceField& field : {DistanceField(Primitive(Box::fromSize(2.0 * half))),
                                     buildField(boxMesh(half), uniform), buildField(boxMesh(half), adaptive)}) {
    CellReader reader(field);
    Random random(1);
    Vector3d p = Vector3d::Zero();
    for (int i = 0; i < 200000; ++i) {
      if (i % 1000 == 0) p = uniformIn(random, {Vector3d::Constant(-0.5), Vector3d::Constant(0.5)});
      p += 0.002 * direction(random);
      const FieldValue expected = field.interpolate(p);
      if (i % 3 == 0) {
        ASSERT_EQ(reader.value(p), expected.value) << p.transpose();
      } else {
        const FieldValue read = reader.interpolate(p);
        ASSERT_EQ(read.value, expected.value) << p.transpose();
        ASSERT_EQ(read.gradient, expected.gradient) << p.transpose();
      }
    }
  }
}

}  // namespace sdf_ccd::cell_reader_test
