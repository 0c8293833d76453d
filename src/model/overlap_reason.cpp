#include "overlap_reason.h"

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

const std::string kOverlap = "overlap at rest", kBeforeDepth = kOverlap + ", ", kAfterDepth = ", and ";

}  // namespace

std::string overlapReason(double depth, const std::string& others) {
  return (depth > 0.0 ? kBeforeDepth + lengthText(depth) + kAfterDepth : kOverlap + " and ") + others;
}

SharedReason sharedReason(const std::string& reason) {
  const std::size_t end = reason.find(kAfterDepth, kBeforeDepth.size());
  if (reason.rfind(kBeforeDepth, 0) != 0 || end == std::string::npos) return {reason, ""};
  return {kOverlap + " and " + reason.substr(end + kAfterDepth.size()),
          reason.substr(kBeforeDepth.size(), end - kBeforeDepth.size())};
}

}  // namespace sdf_ccd
