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
  fuzz::require(response.points.size() == count, "one answer per point");
  for (const PointDistance& point : response.points) {
    fuzz::require(!std::isnan(point.distance) && point.error >= 0.0, "answers are numbers");
    fuzz::require(point.body.empty() == std::isinf(point.distance), "distances are of a body");
  }
  return 0;
}
