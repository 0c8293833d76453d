#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

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
