// Fuzzes requests to query_motion.
#include <cmath>

#include "motion_request.h"
#include "ros/messages/conversions.h"

namespace sdf_ccd::fuzz {
namespace {

void check(const QueryMotion::Response& response) {
  require(response.success || !response.message.empty(), "a refusal has a reason");
  require(response.success || response.verdict == numberOf(Verdict::kNotChecked), "a refusal has no verdict");
  require(!std::isnan(response.error_bound.total), "the error is a number");
  for (const PairContact& pair : response.pairs) {
    require(pair.verdict != numberOf(Verdict::kClear), "pairs that are clear are not listed");
  }
}

}  // namespace
}  // namespace sdf_ccd::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static fuzz::SmallMonitor monitor;
  fuzz::Numbers numbers(data, size);
  QueryMotion::Response response;
  monitor.queries().answer(fuzz::motionRequestOf(numbers), response);
  fuzz::check(response);
  return 0;
}
