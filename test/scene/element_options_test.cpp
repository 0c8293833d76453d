#include "scene/element_options.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/body_options.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::element_options_test {

constexpr double kFinger = 0.0041;  // surface of 5 x 2 x 1.5 cm [m^2]

TEST(ElementOptions, PointsAndCellsFollowTheSizeWithinLimits) {
  const BodyOptions options = optionsForContacts();
  EXPECT_NEAR(shellOptionsFor(options, kFinger, Growth::kSlow).spacing, 0.0025, 1e-4);
  double last = 0.0;
  for (double area = 1e-6; area < 100.0; area *= 1.5) {
    const ShellOptions slow = shellOptionsFor(options, area, Growth::kSlow),
                       full = shellOptionsFor(options, area, Growth::kFull);
    EXPECT_GE(slow.spacing, std::max(last, 1e-3));
    EXPECT_LE(slow.spacing, full.spacing);
    EXPECT_NEAR(slow.vertex_spacing, 0.4 * slow.spacing, 1e-12);
    last = slow.spacing;
    if (slow.spacing < options.shell.spacing) {
      EXPECT_EQ(full.spacing, slow.spacing);
    }
    if (slow.spacing > 1.3e-3) {
      EXPECT_NEAR(*fieldOptionsFor(options, area).cell_size, 1.2 * slow.spacing, 1e-12);
    }
  }
  EXPECT_GT(last, options.shell.spacing);
}

TEST(ElementOptions, LargeElementsGrowByTheFourthRoot) {
  const BodyOptions options = optionsForContacts();
  constexpr double kSide = 25.0 * 0.005;  // of the largest element of the usual spacing [m]
  for (const double times : {1.0, 16.0, 81.0}) {
    const double area = times * times * kSide * kSide;
    EXPECT_NEAR(shellOptionsFor(options, area, Growth::kSlow).spacing, 0.005 * std::pow(times, 0.25), 1e-9);
    EXPECT_NEAR(shellOptionsFor(options, area, Growth::kFull).spacing, 0.005 * times, 1e-9);
  }
}

TEST(ElementOptions, WhatIsGivenHoldsEverywhere) {
  const BodyOptions options = optionsForContacts(0.003);
  for (const double area : {1e-6, kFinger, 10.0}) {
    for (const Growth growth : {Growth::kSlow, Growth::kFull})
      EXPECT_EQ(shellOptionsFor(options, area, growth).spacing, 0.003);
    EXPECT_EQ(*fieldOptionsFor(options, area).cell_size, 1.2 * 0.003);
  }
  EXPECT_EQ(coarsestShell(options), 1.0);
  EXPECT_EQ(coarsestField(options), 1.0);
  EXPECT_GT(std::min(coarsestShell(optionsForContacts()), coarsestField(optionsForContacts())), 100.0);
  EXPECT_EQ(coarsestShell(optionsFor({0.001, {}})), 2.0);
  EXPECT_EQ(coarsestField(optionsFor({0.001, {}})), 2.0);
  BodyOptions given = optionsForContacts();
  setFieldResolution({}, given);
  EXPECT_GT(coarsestShell(given), 100.0);
  EXPECT_EQ(coarsestField(given), 1.0);
}

}  // namespace sdf_ccd::element_options_test
