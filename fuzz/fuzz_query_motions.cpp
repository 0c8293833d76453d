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
