#include "sdf_ccd/result.h"

namespace sdf_ccd {

bool isWorse(Verdict a, Verdict b) {
  const auto severity = [](Verdict verdict) {
    switch (verdict) {
      case Verdict::kClear:
        return 0;
      case Verdict::kNotChecked:
        return 1;
      case Verdict::kUncertain:
        return 2;
      case Verdict::kContact:
        return 3;
    }
    return 1;  // not one of them: nothing is known
  };
  return severity(a) > severity(b);
}

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kClear:
      return "CLEAR";
    case Verdict::kNotChecked:
      return "NOT_CHECKED";
    case Verdict::kUncertain:
      return "UNCERTAIN";
    case Verdict::kContact:
      return "CONTACT";
  }
  return "?";
}

}  // namespace sdf_ccd
