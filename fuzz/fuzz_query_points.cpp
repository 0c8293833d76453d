// Fuzzes requests to query_points.
#include <cmath>

#include "small_monitor.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static fuzz::SmallMonitor monitor;
  fuzz::Numbers numbers(data, size);
  QueryPoints::Request request;
  request.header.frame_id = fuzz::nameOf(numbers);
  const double stamp = numbers.real();
  if (std::abs(stamp) < fuzz::SmallMonitor::kStart) request.header.stamp = ros::Time(std::abs(stamp));
  request.points.resize(numbers.below(8));
  for (auto& point : request.points) {
    point.x = numbers.real();
    point.y = numbers.real();
    point.z = numbers.real();
  }
  QueryPoints::Response response;
  monitor.queries().answer(request, response);
  fuzz::require(response.success || !response.message.empty(), "a refusal has a reason");
  const std::size_t count = response.success ? request.points.size() : 0;
  fuzz::require(response.distances.size() == count && response.errors.size() == count, "one answer per point");
  for (std::size_t i = 0; i < count; ++i) {
    fuzz::require(!std::isnan(response.distances[i]) && response.errors[i] >= 0.0, "answers are numbers");
    fuzz::require(response.bodies[i].empty() == std::isinf(response.distances[i]), "distances are of a body");
  }
  return 0;
}
