#include "scene/error_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sdf_ccd::error_budget_test {

TEST(ErrorBudget, SharesFillTheBudgetButForOnePercent) {
  for (const double error : {1e-5, 1e-3, 0.1}) {
    const ErrorBudget budget = divideErrorBudget(error);
    EXPECT_NEAR(budget.total(), 0.99 * error, 1e-12 * error);
    EXPECT_GT(budget.field, budget.edge_gap);
    EXPECT_GT(budget.edge_gap, budget.chord_tolerance);
    EXPECT_GT(budget.chord_tolerance, 0.02 * error);
  }
  EXPECT_EQ(divideErrorBudget(1e-5).face_spacing, 1e-3);
  EXPECT_EQ(divideErrorBudget(1e-3).face_spacing, 5e-3);
  EXPECT_EQ(divideErrorBudget(0.1).face_spacing, 1e-2);
}

TEST(ErrorBudget, ASampledMotionTakesAFifthOrWhatChordsTake) {
  EXPECT_EQ(samplingTolerance(1e-4, 1e-4), 2e-5);
  EXPECT_EQ(samplingTolerance(1e-2, 1e-4), 1e-4);
}

TEST(ErrorBudget, WhatCannotBeKeptIsRefused) {
  for (const double error : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e-10, 1e-300, 5e-324})
    EXPECT_THROW(divideErrorBudget(error), std::invalid_argument);
}

}  // namespace sdf_ccd::error_budget_test
