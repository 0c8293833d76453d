#include "model/error_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "oracle/failure.h"

namespace sdf_ccd {
namespace {

TEST(ErrorBudget, SharesFillTheBudgetButForOnePercent) {
  for (const double error : {1e-5, 1e-3, 0.1}) {
    const ErrorBudget budget = shareOut(error);
    EXPECT_NEAR(budget.total(), 0.99 * error, 1e-12 * error);
    EXPECT_GT(budget.field, budget.edge_gap);
    EXPECT_GT(budget.edge_gap, budget.chord_tolerance);
    EXPECT_GT(budget.chord_tolerance, 0.02 * error);
  }
  EXPECT_EQ(shareOut(1e-5).face_spacing, 1e-3);
  EXPECT_EQ(shareOut(1e-3).face_spacing, 5e-3);
  EXPECT_EQ(shareOut(0.1).face_spacing, 1e-2);
}

TEST(ErrorBudget, WhatIsGivenStaysAndTheOthersTakeTheRest) {
  const ErrorBudget coarse = shareOut(0.001, {0.0008, {}, {}}), fine = shareOut(0.001, {0.0001, {}, {}});
  EXPECT_EQ(coarse.field, 0.0008);
  EXPECT_NEAR(coarse.total(), 0.00099, 1e-12);
  EXPECT_NEAR(fine.total(), 0.00099, 1e-12);
  EXPECT_LT(coarse.edge_gap, fine.edge_gap);
  EXPECT_NEAR(coarse.edge_gap / coarse.chord_tolerance, fine.edge_gap / fine.chord_tolerance, 1e-9);
  const ErrorBudget all = shareOut(0.001, {0.0001, 0.0002, 0.0001});
  EXPECT_NEAR(all.total(), 0.0006, 1e-12);
}

TEST(ErrorBudget, WhatCannotBeKeptIsRefused) {
  for (const double error : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e-10, 1e-300, 5e-324})
    EXPECT_THROW(shareOut(error), std::invalid_argument);
  EXPECT_THROW(shareOut(0.001, {0.001, {}, {}}), std::invalid_argument);
  EXPECT_THROW(shareOut(0.001, {{}, 0.0005, 0.0002}), std::invalid_argument);
  EXPECT_THROW(shareOut(0.001, {0.0005, 0.0005, 0.0001}), std::invalid_argument);
  EXPECT_THROW(shareOut(0.001, {{}, -0.0005, {}}), std::invalid_argument);
  EXPECT_EQ(test::failureOf<std::invalid_argument>([] { shareOut(0.001, {0.002, {}, {}}); }),
            "a max_error of 0.001 m cannot be kept: what is given takes 0.002 m of it");
}

}  // namespace
}  // namespace sdf_ccd
