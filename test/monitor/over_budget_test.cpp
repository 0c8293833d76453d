#include "monitor/over_budget.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"

namespace sdf_ccd::over_budget_test {

using namespace test;

TEST(OverBudget, NothingToSayWhereTheBoundIsKept) {
  const BodyOptions options = optionsFor({0.002});
  const auto scene = build({body("a", Primitive(Sphere{0.1})), body("b", meshShape(icosphere(0.1, 2)))}, options);
  EXPECT_EQ(overBudget(*scene), "");
}

/// Links that move fast between two transforms.
TEST(OverBudget, SaysWhatMotionsTake) {
  BodyOptions options = optionsFor({0.002});
  options.motion_error = 0.003;
  const auto scene = build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))}, options);
  const std::string text = overBudget(*scene);
  EXPECT_EQ(text.find("the error bound is 3 mm, more than the max_error of 2 mm: 3 mm of motions"), 0u) << text;
  options.max_error.reset();
  EXPECT_EQ(overBudget(*build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))}, options)), "");
}

}  // namespace sdf_ccd::over_budget_test
