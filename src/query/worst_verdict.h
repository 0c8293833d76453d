#pragma once

#include <optional>

#include "sdf_ccd/result.h"

namespace sdf_ccd {

/// The most severe of several verdicts.
class WorstVerdict {
 public:
  /// Adds one of them.
  void add(Verdict verdict) { worst_ = worst_ ? worseOf(*worst_, verdict) : verdict; }

  /// NOT_CHECKED if there are none.
  Verdict value() const { return worst_.value_or(Verdict::kNotChecked); }

 private:
  std::optional<Verdict> worst_;
};

}  // namespace sdf_ccd
