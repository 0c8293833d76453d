#include "scene/no_pairs.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"

namespace sdf_ccd::no_pairs_test {

using namespace test;

TEST(NoPairs, AreToldWithTheReason) {
  const auto why = [](const SceneDescription& description) { return whyNoPairs(*build(description)); };
  const BodyDescription a = body("a", Primitive(Sphere{0.1})), b = body("b", Primitive(Sphere{0.1}));
  const BodyDescription box = body("box", Primitive(Sphere{0.1}), true),
                        lid = body("lid", Primitive(Sphere{0.1}), true);
  EXPECT_EQ(why({{a, b}, {}}), "");
  EXPECT_EQ(why({{}, {}}), "nothing is checked: there is no body");
  EXPECT_EQ(why({{a}, {}}), "nothing is checked: there is only the body a");
  EXPECT_EQ(why({{box, lid}, {}}), "nothing is checked: all bodies are the world's");
  EXPECT_EQ(why({{a, b, box}, {{"a", "b", "SRDF: Never"}, {"a", "box", "far"}, {"b", "box", "far"}}}),
            "nothing is checked: all pairs are left out, 2 of them because of: far");
  Scene scene = *build({a, b});
  leaveOut({{"a", "b", "they overlap", PairKind::kAtRest, 0.0, {}, 0, 1}}, scene);
  EXPECT_NE(planTable(scene).find("notes:\n  nothing is checked: all pairs are left out, 1 of them because of: they "
                                  "overlap\n"),
            std::string::npos)
      << planTable(scene);
}

}  // namespace sdf_ccd::no_pairs_test
