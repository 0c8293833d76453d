#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "common/number_text.h"
#include "scene_cost.h"

namespace sdf_ccd {
namespace {

constexpr double kSurely = 2.0;  // estimates are accurate to this factor

/// Size of the body's largest bounded element [m]; 0 if it has none.
double sizeOf(const BodyDescription& body) {
  double size = 0.0;
  for (const GeometryDescription& geometry : body.geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
    if (mesh && !*mesh) continue;
    const AlignedBox3d box = primitive ? boundingBox(*primitive) : boundingBox(**mesh);
    if (box.sizes().allFinite() && !box.isEmpty()) size = std::max(size, box.sizes().norm());
  }
  return size;
}

void requireSmallerThanBodies(const SceneDescription& description, double max_error) {
  const BodyDescription* largest = nullptr;
  double longest = 0.0;
  for (const BodyDescription& body : description.bodies) {
    const double size = sizeOf(body);
    if (size <= longest) continue;
    longest = size;
    largest = &body;
  }
  if (!largest || max_error <= longest) return;
  throw std::invalid_argument("a max_error of " + numberText(max_error) + " m is larger than every body: " +
                              largest->name + " is " + numberText(longest) + " m long");
}

double machineBytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

/// The limit that the cost certainly exceeds; empty if there is none.
std::string exceededLimit(const SceneCost& cost, const BodyOptions& options) {
  if (cost.bytes > machineBytes()) return "this machine has " + memoryText(machineBytes());
  if (!options.divides_max_error) return "";  // building will name the bodies whose settings exceed a limit
  const auto most_bytes = static_cast<double>(options.field.max_bytes);
  const auto most_points = static_cast<double>(options.shell.max_points);
  for (const BodyCost& body : cost.bodies) {
    if (body.largest_field > kSurely * most_bytes)
      return "a field may take " + memoryText(most_bytes) + ", that of " + body.name + " would take " +
             memoryText(body.largest_field);
    if (body.largest_shell > kSurely * most_points)
      return "a shell may have " + numberText(most_points) + " points, that of " + body.name + " would have " +
             numberText(std::round(body.largest_shell));
  }
  return "";
}

}  // namespace

void requireAffordable(const SceneCost& cost, const BodyOptions& options) {
  const std::string limit = exceededLimit(cost, options);
  if (limit.empty()) return;
  const std::string what = options.divides_max_error ? "a max_error of " + numberText(*options.max_error) + " m"
                                                     : "such fine fields and shells";
  throw std::length_error(what + " would take " + summary(cost) + "; " + limit);
}

SceneCost affordableCost(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options) {
  if (options.max_error) requireSmallerThanBodies(description, *options.max_error);
  const SceneCost cost = expectedCost(description, plan, options);
  requireAffordable(cost, options);
  return cost;
}

ScenePlan affordablePlan(const SceneDescription& description, const BodyOptions& options) {
  ScenePlan plan = planScene(description, planOptions(options));
  plan.expected = std::make_shared<const SceneCost>(affordableCost(description, plan, options));
  return plan;
}

}  // namespace sdf_ccd
