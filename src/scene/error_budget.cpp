#include "scene/error_budget.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

constexpr double kFieldPart = 0.55, kEdgePart = 0.35, kChordPart = 0.09, kSamplingPart = 0.2;

// Points of faces give forces, not verdicts. At five times the error, faces of a robot have about as many as edges.
constexpr double kFacesPerError = 5.0, kFinestFaces = 1e-3, kCoarsestFaces = 1e-2;

constexpr double kMinError = 1e-9;  // [m]: rounding adds up to more

}  // namespace

ErrorBudget divideErrorBudget(double max_error) {
  if (!(max_error > 0.0) || !std::isfinite(max_error))
    throw std::invalid_argument("max_error must be positive, not " + numberText(max_error) + " m");
  if (max_error < kMinError)
    throw std::invalid_argument("max_error must be at least " + numberText(kMinError) + " m, not " +
                                numberText(max_error) + " m");
  ErrorBudget budget;
  budget.field = kFieldPart * max_error;
  budget.edge_gap = kEdgePart * max_error;
  budget.chord_tolerance = kChordPart / ErrorBudget::kChords * max_error;
  budget.face_spacing = std::clamp(kFacesPerError * max_error, kFinestFaces, kCoarsestFaces);
  return budget;
}

double samplingTolerance(double max_error, double chord_tolerance) {
  return std::min(chord_tolerance, kSamplingPart * max_error);
}

}  // namespace sdf_ccd
