#include "scene/build_body.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "scene/body_solid.h"
#include "scene/body_triangles.h"
#include "scene/geometry_keys.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

template <class T>
void appendTo(std::string& key, const T& number) {
  static_assert(std::is_arithmetic_v<T>);
  key.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// An absent number differs from zero.
template <class T>
void appendTo(std::string& key, const std::optional<T>& number) {
  appendTo(key, number.has_value());
  if (number) appendTo(key, *number);
}

/// Geometry and options of a body, with the names of meshes, which warnings contain.
std::string contentKey(const BodyDescription& description, const BodyNeeds& needs, const BodyOptions& options,
                       GeometryKeys& keys) {
  const auto& [field_options, shell_options, points_across, cells_across, motion_margin, motion_error, cache, is_shared,
               max_error, max_preparation_time, divides_max_error] = options;
  static_cast<void>(cache);
  static_cast<void>(is_shared);
  static_cast<void>(max_preparation_time);
  const auto& [cells, cell_size, field_error, band, max_bytes] = field_options;
  const auto& [spacing, edge_gap, has_siblings, vertex_spacing, seed, max_points] = shell_options;
  const auto& [field, shell, triangles, surface] = needs;
  static_cast<void>(triangles);  // added to the shared body, as the surface
  static_cast<void>(surface);
  std::string key = keys.keyOf(description);
  const auto add = [&](const auto&... values) { (appendTo(key, values), ...); };
  add(cells, cell_size, field_error, band, max_bytes);
  add(spacing, edge_gap, has_siblings, vertex_spacing, seed, max_points);
  add(points_across, cells_across, motion_margin, motion_error, max_error, divides_max_error);
  add(field, shell);
  for (const GeometryDescription& geometry : description.geometry) key += geometry.source + '\n';
  return key;
}

/// Contains the body's elements; see kHalfSpaceRadius.
BoundingBall ballOf(const Body& body) {
  BoundingBall ball;
  if (body.triangles) {
    ball = body.triangles->tree.ball();
    ball.radius += std::max(body.triangles->deviation, body.shell->position_error);  // of points that are rounded
  } else {
    AlignedBox3d box_B;
    for (const BodyPart& part : body.parts) {
      const AlignedBox3d& box_G = part.field.surfaceBox();
      if (box_G.sizes().allFinite()) box_B.extend(box_G.transformed(part.X_BG));
    }
    if (!box_B.isEmpty()) ball = {box_B.center(), 0.5 * box_B.diagonal().norm()};
  }
  if (body.half_spaces.empty()) return ball;
  return {Vector3d::Zero(), std::max(kHalfSpaceRadius, ball.center.norm() + ball.radius)};
}

/// Whether the body's solid comes with its forces: that of a large mesh takes longer than what decides verdicts.
bool isSolidAwaited(const BodyDescription& description, MeshPool& pool) {
  constexpr std::size_t kLarge = 20000;  // triangles
  if (description.forces != Forces::kAwaited) return false;
  std::size_t triangles = 0;
  for (const GeometryDescription& geometry : description.geometry)
    if (!std::holds_alternative<Primitive>(geometry.shape)) triangles += pool.find(geometry).mesh.triangles.size();
  return triangles > kLarge;
}

/// As buildBody(), but for the limit of time.
BuiltBody buildInAnyTime(const BodyDescription& description, const BodyNeeds& needs, const BodyOptions& options,
                         MeshPool& pool, const Progress& progress) {
  WeakStore<BuiltBody>& shared = pool.content().bodies;
  const std::string key = contentKey(description, needs, options, pool.keys());
  std::shared_ptr<const BuiltBody> known = shared.find(key);
  const bool was_known = known != nullptr;
  if (!was_known) {
    BuiltBody built = buildUnshared(description, needs, options, pool, progress);
    if (!built.body.failure.empty()) return built;
    known = shared.keep(key, std::make_shared<const BuiltBody>(std::move(built)));
  }
  BuiltBody mine = *known;
  mine.body.content = known;
  static_cast<BodyPlace&>(mine.body) = description;
  mine.report.name = description.name;
  if (was_known) countAsShared(mine.report);
  if (needs.triangles) mine.body.triangles = trianglesOf(description, pool);
  if (mine.body.triangles && !was_known) mine.report.shell_bytes += mine.body.triangles->bytes();
  if (needs.triangles && !isSolidAwaited(description, pool)) mine.body.solid = solidOf(description, pool);
  if (mine.body.solid && !was_known) mine.report.shell_bytes += mine.body.solid->bytes();
  if (needs.surface) mine.body.surface = surfaceOf(description, pool);
  mine.body.ball = ballOf(mine.body);
  return mine;
}

}  // namespace

BuiltBody buildBody(const BodyDescription& description, const BodyNeeds& needs, const BodyOptions& options,
                    MeshPool& pool, const Progress& progress) {
  if (!description.failure.empty() || !needs.any()) return buildUnshared(description, needs, options, pool, progress);
  try {
    return pool.withinTime(description, [&] { return buildInAnyTime(description, needs, options, pool, progress); });
  } catch (const TookTooLong& late) {
    return failedBody(description, late.what());
  } catch (const std::invalid_argument& problem) {
    return failedBody(description, problem.what());
  }
}

void countAsShared(BodyReport& report) {
  if (report.field.state == PartState::kReady && report.field.text != "exact") report.field.text = "shared";
  report.field_bytes = report.shell_bytes = 0;
}

}  // namespace sdf_ccd
