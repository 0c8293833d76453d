// Fuzzes requests to query_motions.
#include <cmath>

#include "motion_request.h"

namespace sdf_ccd::fuzz {
namespace {

QueryMotions::Request requestOf(Numbers& numbers) {
  QueryMotions::Request request;
  const std::size_t what = numbers.byte();
  request.all = (what & 1) != 0;
  request.interpolation = static_cast<std::uint8_t>(numbers.below(4));
  request.list_pairs = (what & 4) != 0;
  if (what & 2) request.margin = numbers.real();
  const QueryMotion::Request others = motionRequestOf(numbers);
  request.other_joints = others.other_joints;
  request.other_positions = others.other_positions;
  request.allow_beyond_limits = others.allow_beyond_limits;
  for (std::size_t i = numbers.below(4); i > 0; --i) {
    const QueryMotion::Request one = motionRequestOf(numbers);
    request.motions.emplace_back();
    request.motions.back().joint_trajectory = one.trajectory;
    request.motions.back().multi_dof_joint_trajectory = one.multi_dof_trajectory;
  }
  return request;
}

void check(const QueryMotions::Request& request, const QueryMotions::Response& response) {
  require(response.success || !response.message.empty(), "a refusal has a reason");
  const std::size_t count = response.success ? request.motions.size() : 0;
  require(response.verdicts.size() == count && response.error_bounds.size() == count, "a verdict for each motion");
  require(response.bodies_a.size() == count && response.bodies_b.size() == count && response.times.size() == count,
          "a place for each motion");
  const std::size_t pairs = response.pair_motions.size();
  require(response.pair_verdicts.size() == pairs && response.pairs_a.size() == pairs &&
              response.pairs_b.size() == pairs && response.pair_times.size() == pairs &&
              (request.list_pairs || pairs == 0),
          "pairs are listed as a whole, if wanted");
  for (const std::uint32_t motion : response.pair_motions) require(motion < count, "a pair is of a motion");
  for (const double bound : response.error_bounds) require(bound >= 0.0, "bounds are numbers, none is negative");
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
