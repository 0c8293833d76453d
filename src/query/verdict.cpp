#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kClear:
      return "CLEAR";
    case Verdict::kContact:
      return "CONTACT";
    case Verdict::kUncertain:
      return "UNCERTAIN";
    case Verdict::kNotChecked:
      return "NOT_CHECKED";
  }
  return "?";
}

}  // namespace sdf_ccd
