#include "model/overlap_reason.h"

#include <gtest/gtest.h>

namespace sdf_ccd {
namespace {

TEST(OverlapReason, PairsOfAllDepthsShareOneText) {
  const std::string shallow = overlapReason(0.00557, "always"), deep = overlapReason(1.234, "always"),
                    unknown = overlapReason(0.0, "always");
  EXPECT_EQ(shallow, "overlap at rest, 5.57 mm, and always");
  EXPECT_EQ(deep, "overlap at rest, 1.23 m, and always");
  EXPECT_EQ(sharedReason(shallow).text, unknown);
  EXPECT_EQ(sharedReason(shallow).depth, "5.57 mm");
  EXPECT_EQ(sharedReason(deep).text, unknown);
  EXPECT_EQ(sharedReason(deep).depth, "1.23 m");
  EXPECT_EQ(sharedReason(unknown).text, unknown);
  EXPECT_EQ(sharedReason(unknown).depth, "");
}

TEST(OverlapReason, OtherReasonsStay) {
  for (const char* reason : {"", "SRDF: Adjacent", "overlap at rest", "overlap at rest, ", "overlap", ", and "}) {
    EXPECT_EQ(sharedReason(reason).text, reason);
    EXPECT_EQ(sharedReason(reason).depth, "");
  }
}

}  // namespace
}  // namespace sdf_ccd
