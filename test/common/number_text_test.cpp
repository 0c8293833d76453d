#include "common/number_text.h"

#include <gtest/gtest.h>

namespace sdf_ccd::number_text_test {

TEST(NumberText, LengthsHaveAUnitThatFits) {
  EXPECT_EQ(lengthText(0.0), "0 mm");
  EXPECT_EQ(lengthText(2.1e-6), "0.0021 mm");
  EXPECT_EQ(lengthText(1.34e-2), "13.4 mm");
  EXPECT_EQ(lengthText(0.9994), "999 mm");
  EXPECT_EQ(lengthText(0.9999), "1.00 m");
  EXPECT_EQ(lengthText(1234.5678), "1234.57 m");
}

TEST(NumberText, LargeDurationsAndMemoryHaveNoExponent) {
  EXPECT_EQ(durationText(0.01234), "0.0123 s");
  EXPECT_EQ(durationText(999.4), "999 s");
  EXPECT_EQ(durationText(999.9), "1000 s");
  EXPECT_EQ(durationText(123456.7), "123457 s");
  EXPECT_EQ(memoryText(12'345.0), "0.0123 MB");
  EXPECT_EQ(memoryText(268'435'456.0), "268 MB");
  EXPECT_EQ(memoryText(4e9), "4000 MB");
}

TEST(NumberText, Digits) {
  EXPECT_EQ(numberText(1e300), "1e+300");
  EXPECT_EQ(shortText(1234.5), "1.23e+03");
  EXPECT_EQ(fixedText(2.0, 3), "2.000");
}

}  // namespace sdf_ccd::number_text_test
