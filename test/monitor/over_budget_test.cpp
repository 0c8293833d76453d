#include "monitor/over_budget.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"

namespace sdf_ccd::over_budget_test {

using namespace test;

BodyDescription map() {
  BodyDescription map = body("map", meshShape(boxMesh({0.5, 0.5, 0.1})), true);
  map.geometry[0].watertight_voxels = true;
  return map;
}

TEST(OverBudget, NothingToSayWhereTheBoundIsKept) {
  const BodyOptions options = optionsFor({0.002});
  const auto scene = build({body("a", Primitive(Sphere{0.1})), body("b", meshShape(icosphere(0.1, 2)))}, options);
  EXPECT_EQ(overBudget(*scene), "");
  BodyOptions not_asked = options;
  not_asked.max_error.reset();
  EXPECT_EQ(overBudget(*build({map(), body("b", Primitive(Sphere{0.1}))}, not_asked)), "");
}

TEST(OverBudget, NamesWhatIsOnlyAField) {
  const BodyOptions options = optionsFor({0.002});
  const auto scene = build(
      {map(), body("hand", meshShape(boxMesh({0.1, 0.05, 0.05}))), body("finger", Primitive(Sphere{0.02}))}, options);
  const std::string text = overBudget(*scene);
  EXPECT_EQ(text.find("the error bound is "), 0u) << text;
  EXPECT_NE(text.find("more than the max_error of 2 mm: map is used only as a field"), std::string::npos) << text;
  EXPECT_NE(text.find("instead of 0.7 mm"), std::string::npos) << text;
  EXPECT_EQ(text.find("map is used only as a field"), text.rfind("map is used only as a field"))
      << text;  // once for both pairs
}

TEST(OverBudget, NamesWhatWasMadeCoarser) {
  BodyOptions options = optionsFor({0.0005});
  options.field.max_bytes = 100'000;
  options.shell.max_points = 3000;
  const auto scene =
      build({body("a", meshShape(icosphere(0.1, 3))), body("b", Primitive(Box{{0.1, 0.1, 0.1}}))}, options);
  EXPECT_EQ(overBudget(*scene), "");  // triangles decide
  Scene without = *scene;             // as for bodies with more than half a million triangles
  without.bodies = {};
  for (Body body : scene->bodies) {
    body.triangles.reset();
    without.bodies.push_back(std::move(body));
  }
  without.bound = without.contact_bound;
  const std::string text = overBudget(without);
  EXPECT_NE(text.find("the field of a has an error of "), std::string::npos) << text;
  EXPECT_NE(text.find("b has gaps of "), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace sdf_ccd::over_budget_test
