#include "common/compiler_lanes.h"

#include <gtest/gtest.h>

namespace sdf_ccd::compiler_lanes_test {

using namespace lanes;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

TEST(CompilerLanes, TheLeastMayBeInAnyLane) {
  for (int i = 0; i < kFloatWidth; ++i) {
    Floats v = Floats{} + 3.0F;
    v[i] = -7.5F;
    EXPECT_EQ(leastOf(v), -7.5F) << "lane " << i;
    v[i] = -kInf;
    EXPECT_EQ(leastOf(v), -kInf) << "lane " << i;
  }
}

TEST(CompilerLanes, AComparisonSetsTheBitsOfItsLanes) {
  for (int bits = 0; bits < 256; ++bits) {
    Floats v;
    for (int i = 0; i < kFloatWidth; ++i) v[i] = (bits >> i & 1) != 0 ? 2.0F : 1.0F;
    EXPECT_EQ(bitsOf(v > Floats{} + 1.5F), static_cast<std::uint32_t>(bits));
  }
  const Floats v = {1.0F, kNan, kInf, -kInf, 0.0F, -0.0F, kNan, 5.0F};
  EXPECT_EQ(bitsOf(v > Floats{}), 0x85U) << "what is not a number is not above";
  EXPECT_EQ(bitsOf(~(v > Floats{})), 0x7aU);
}

TEST(CompilerLanes, AmountsHaveNoSign) {
  const Floats amounts = absolute(Floats{1.5F, -1.5F, 0.0F, -0.0F, kInf, -kInf, -1e-45F, kNan});
  const float expected[] = {1.5F, 1.5F, 0.0F, 0.0F, kInf, kInf, 1e-45F};
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(amounts[i], expected[i]);
    EXPECT_FALSE(std::signbit(amounts[i]));
  }
  EXPECT_TRUE(std::isnan(amounts[7]));
  const Doubles of_doubles = absolute(Doubles{-2.5, 2.5, -0.0, -5e-324});
  EXPECT_EQ(of_doubles[0], 2.5);
  EXPECT_EQ(of_doubles[1], 2.5);
  EXPECT_FALSE(std::signbit(of_doubles[2]));
  EXPECT_EQ(of_doubles[3], 5e-324);
}

}  // namespace sdf_ccd::compiler_lanes_test
