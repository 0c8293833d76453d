// Fuzzes requests to query_motions.
#include <cmath>

#include "motion_request.h"
#include "ros/messages/conversions.h"

namespace sdf_ccd::fuzz {
namespace {

QueryMotions::Request requestOf(Numbers& numbers) {
  QueryMotions::Request request;
  const std::size_t what = numbers.byte();
  request.all = (what & 1) != 0;
  const auto interpolation = static_cast<std::uint8_t>(numbers.below(4));
  request.list_pairs = (what & 4) != 0;
  if (what & 2) request.margin = numbers.real();
  request.allow_beyond_limits = motionRequestOf(numbers).allow_beyond_limits;
  for (std::size_t i = numbers.below(4); i > 0; --i) {
    request.motions.push_back(motionRequestOf(numbers).motion);
    request.motions.back().interpolation = interpolation;
  }
  return request;
}

void check(const QueryMotions::Request& request, const QueryMotions::Response& response) {
  require(response.success || !response.message.empty(), "a refusal has a reason");
  const std::size_t count = response.success ? request.motions.size() : 0;
  require(response.motions.size() == count, "a verdict for each motion");
  for (const CheckedMotion& motion : response.motions) {
    require(motion.error_bound >= 0.0, "bounds are numbers, none is negative");
    require(request.list_pairs || motion.pairs.empty(), "pairs are listed if wanted");
    for (const CheckedPair& pair : motion.pairs)
      require(pair.verdict != numberOf(Verdict::kClear), "listed pairs are not clear");
  }
}

}  // namespace
}  // namespace sdf_ccd::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static fuzz::SmallMonitor monitor;
  fuzz::Numbers numbers(data, size);
  const QueryMotions::Request request = fuzz::requestOf(numbers);
  QueryMotions::Response response;
  monitor.queries().answer(request, response);
  fuzz::check(request, response);
  return 0;
}
