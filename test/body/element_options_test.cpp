#include "body/element_options.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sdf_ccd {
namespace {

constexpr double kFinger = 0.0041;  // surface of 5 x 2 x 1.5 cm [m^2]

TEST(ElementOptions, PointsAndCellsFollowTheSizeWithinLimits) {
  const BodyOptions options = optionsForContacts();
  EXPECT_NEAR(shellOptionsFor(options, kFinger).spacing, 0.0025, 1e-4);
  double last = 0.0;
  for (double area = 1e-6; area < 100.0; area *= 1.5) {
    const ShellOptions shell = shellOptionsFor(options, area);
    const FieldOptions field = fieldOptionsFor(options, area);
    EXPECT_GE(shell.spacing, std::max(last, 1e-3));
    EXPECT_LE(shell.spacing, options.shell.spacing);
    EXPECT_NEAR(shell.vertex_spacing, 0.4 * shell.spacing, 1e-12);
    if (shell.spacing > 1.3e-3) EXPECT_NEAR(*field.cell_size, 1.2 * shell.spacing, 1e-12);
    last = shell.spacing;
  }
  EXPECT_EQ(last, options.shell.spacing);
}

TEST(ElementOptions, WhatIsGivenHoldsEverywhere) {
  const BodyOptions options = optionsForContacts(0.003);
  for (const double area : {1e-6, kFinger, 10.0}) {
    EXPECT_EQ(shellOptionsFor(options, area).spacing, 0.003);
    EXPECT_EQ(*fieldOptionsFor(options, area).cell_size, 1.2 * 0.003);
  }
  EXPECT_FALSE(mayBeCoarser(options));
  EXPECT_TRUE(mayBeCoarser(optionsForContacts()));
  EXPECT_TRUE(mayBeCoarser(optionsFor({0.001, {}})));
}

}  // namespace
}  // namespace sdf_ccd
