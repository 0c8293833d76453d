#include "common/nearest_name.h"

#include <gtest/gtest.h>

namespace sdf_ccd::nearest_name_test {

TEST(NearestName, FindsWhatWasMeant) {
  const std::set<std::string> known = {"xyz", "rpy", "frame", "cell_size", "cells", "max_error", "name"};
  EXPECT_EQ(nearestName("xzy", known), "xyz");  // swapped
  EXPECT_EQ(nearestName("XYZ", known), "xyz");
  EXPECT_EQ(nearestName("fram", known), "frame");    // left out
  EXPECT_EQ(nearestName("framme", known), "frame");  // in excess
  EXPECT_EQ(nearestName("cel_size", known), "cell_size");
  EXPECT_EQ(nearestName("max-error", known), "max_error");  // replaced
  EXPECT_EQ(nearestName("stiffness", known), "");
  EXPECT_EQ(nearestName("", known), "");
  EXPECT_EQ(nearestName("q", known), "");
  EXPECT_EQ(nearestName(std::string(100000, 'x'), known), "");
}

TEST(NearestName, SuggestsOrListsWhatIsKnown) {
  EXPECT_EQ(suggestion("xzy", {"xyz", "rpy"}), ", did you mean xyz?");
  EXPECT_EQ(suggestion("stiffness", {"a", "b", "c"}), ", known names: a, b and c");
  EXPECT_EQ(suggestion("stiffness", {}), "");
}

}  // namespace sdf_ccd::nearest_name_test
