#include "common/read_number.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/number_text.h"
#include "oracle/german_locale.h"

namespace sdf_ccd::read_number_test {

TEST(ReadNumber, IsTheWholeTextOrNone) {
  EXPECT_EQ(wholeNumber("1.5"), 1.5);
  EXPECT_EQ(wholeNumber(" -2.5e-3\t\r"), -2.5e-3);
  EXPECT_EQ(wholeNumber(".5"), 0.5);
  EXPECT_EQ(wholeNumber("1e5"), 1e5);
  EXPECT_EQ(wholeNumber("inf"), HUGE_VAL);
  for (const char* text : {"", " ", ".", "1,5", "1.5x", "1.5 2", "x", "1e", "0x", "1.000.000"})
    EXPECT_FALSE(wholeNumber(text)) << text;
  EXPECT_FALSE(wholeNumber(std::string("1.5\0", 4)));
}

TEST(ReadNumber, ThePointIsTheDecimalSignInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  const test::GermanLocale german;
  EXPECT_EQ(wholeNumber("1.5"), 1.5);
  EXPECT_EQ(wholeNumber("1e-3"), 1e-3);
  EXPECT_FALSE(wholeNumber("1,5"));
  EXPECT_EQ(numberText(1234567.5), "1.23457e+06");
  EXPECT_EQ(shortText(0.25), "0.25");
  EXPECT_EQ(fixedText(12345.25, 2), "12345.25");
  EXPECT_EQ(vectorText({0.5, 1.25, -2.0}), "(0.5, 1.25, -2)");
}

}  // namespace sdf_ccd::read_number_test
