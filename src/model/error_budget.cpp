#include "model/error_budget.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

constexpr double kFieldPart = 0.55, kEdgePart = 0.35, kChordPart = 0.09;
constexpr double kUsed = kFieldPart + kEdgePart + kChordPart;

// Points of faces bear forces, not verdicts. At five times the error a robot's faces have about as many as its edges.
constexpr double kFacesPerError = 5.0, kFinestFaces = 1e-3, kCoarsestFaces = 1e-2;

constexpr double kLeastError = 1e-9;  // [m]: rounding adds up to more

double positive(double value, const char* what) {
  if (value > 0.0 && std::isfinite(value)) return value;
  throw std::invalid_argument(std::string(what) + " must be positive, not " + numberText(value) + " m");
}

}  // namespace

ErrorBudget shareOut(double max_error, const GivenShares& given) {
  positive(max_error, "max_error");
  if (max_error < kLeastError) {
    throw std::invalid_argument("max_error must be at least " + numberText(kLeastError) + " m, not " +
                                numberText(max_error) + " m");
  }
  double taken = 0.0, parts = 0.0;
  const auto take = [&](const std::optional<double>& share, double times, double part, const char* what) {
    if (share) taken += times * positive(*share, what);
    if (!share) parts += part;
  };
  take(given.field, 1.0, kFieldPart, "the field's error");
  take(given.edge_gap, 1.0, kEdgePart, "the gap between points on edges");
  take(given.chord_tolerance, ErrorBudget::kChords, kChordPart, "the chord tolerance");
  const double left = kUsed * max_error - taken;
  if (taken > max_error || (parts > 0.0 && left <= 0.0)) {
    throw std::invalid_argument("a max_error of " + numberText(max_error) + " m cannot be kept: what is given takes " +
                                numberText(taken) + " m of it");
  }
  const double unit = parts > 0.0 ? left / parts : 0.0;
  ErrorBudget budget;
  budget.field = given.field.value_or(kFieldPart * unit);
  budget.edge_gap = given.edge_gap.value_or(kEdgePart * unit);
  budget.chord_tolerance = given.chord_tolerance.value_or(kChordPart / ErrorBudget::kChords * unit);
  budget.face_spacing = std::clamp(kFacesPerError * max_error, kFinestFaces, kCoarsestFaces);
  return budget;
}

}  // namespace sdf_ccd
