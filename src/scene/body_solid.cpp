#include "body_solid.h"

#include <algorithm>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

/// A mesh and how far it may be from the body's surface [m].
struct Boundary {
  std::shared_ptr<const Solid> solid;  // null if it is not certain
  double deviation = 0.0;
};

/// How much too small the depths in a solid may be [m], because of faces inside it; infinite if that is not known.
double doubtOf(const Solid& solid) {
  const bool is_solid = solid.closed() && solid.report().failure.empty();
  return is_solid ? solid.report().doubtful_reach : kInfinity;
}

/// Slivers that may lie inside a mesh matter no more than this.
bool isCertain(const Solid& solid) {
  constexpr double kMost = 2e-5, kMostOfSize = 5e-5;  // [m]
  return doubtOf(solid) <= std::max(kMost, kMostOfSize * boundingBox(solid.boundary()).sizes().maxCoeff());
}

Boundary boundaryOf(PooledMesh& pooled) {
  if (pooled.quality.doubtful) return {};
  const SolidSource source(pooled.mesh, pooled.made);
  if (isCertain(source.solid())) return {pooled.made.solid, doubtOf(source.solid())};
  if (isClosed(pooled.mesh)) return {};
  const ClosedSolid& closed = source.closed();
  if (!closed.hasCracksAlone() || !isCertain(closed.solid())) return {};
  const std::vector<double>& reach = closed.openings().reach;
  const double widest = reach.empty() ? 0.0 : *std::max_element(reach.begin(), reach.end());
  return {{pooled.made.closed, &closed.solid()}, closed.moved() + widest + doubtOf(closed.solid())};
}

/// With a larger radius [m].
Primitive grown(Primitive primitive, double by) {
  if (auto* ball = std::get_if<Sphere>(&primitive)) ball->radius += by;
  if (auto* cylinder = std::get_if<Cylinder>(&primitive)) cylinder->radius += by;
  return primitive;
}

/// Fine enough for depths to a tenth of the default error. What is round is contained: a pin that fits into its hole
/// fills it, and where round elements meet there is no gap.
Boundary boundaryOf(const Primitive& primitive, bool is_inner) {
  constexpr double kFine = 5e-6, kFineOfSize = 1e-5;
  const double fine = std::max(kFine, kFineOfSize * boundingBox(primitive).sizes().maxCoeff());
  const bool is_exact = std::holds_alternative<Box>(primitive);
  const Primitive shape = is_inner ? primitive : grown(primitive, fine);
  return {std::make_shared<const Solid>(tessellate(shape, fine)), is_exact ? 0.0 : fine};
}

Boundary boundaryOf(const GeometryDescription& element, MeshPool& pool, bool is_inner = false) {
  const auto* primitive = std::get_if<Primitive>(&element.shape);
  return primitive ? boundaryOf(*primitive, is_inner) : boundaryOf(pool.find(element));
}

/// All elements as one. @param is_inner  contained in the body, instead of containing it.
Boundary unionOf(const std::vector<const GeometryDescription*>& elements, MeshPool& pool, bool is_inner) {
  TriangleMesh all;
  double deviation = 0.0;
  for (const GeometryDescription* element : elements) {
    const Boundary boundary = boundaryOf(*element, pool, is_inner);
    if (!boundary.solid) return {};
    deviation = std::max(deviation, boundary.deviation);
    all = merged(std::move(all), transformed(boundary.solid->boundary(), element->X_BG));
  }
  auto solid = std::make_shared<const Solid>(all);
  if (!isCertain(*solid)) return {};
  deviation += doubtOf(*solid);
  return {std::move(solid), deviation};
}

bool isRound(const GeometryDescription& element) {
  const auto* primitive = std::get_if<Primitive>(&element.shape);
  return primitive && !std::holds_alternative<Box>(*primitive);
}

std::shared_ptr<const DepthSolid> ownSolidOf(const BodyDescription& description, MeshPool& pool) {
  std::vector<const GeometryDescription*> elements;
  for (const GeometryDescription& geometry : description.geometry) {
    if (geometry.watertight_voxels) return nullptr;
    if (!isHalfSpace(geometry)) elements.push_back(&geometry);
  }
  if (elements.empty()) return nullptr;
  const GeometryDescription& first = *elements.front();
  if (elements.size() == 1) {
    const auto* primitive = std::get_if<Primitive>(&first.shape);
    const auto* ball = primitive ? std::get_if<Sphere>(primitive) : nullptr;
    if (ball) return std::make_shared<const DepthSolid>(*ball, first.X_BG);
    const Boundary boundary = boundaryOf(first, pool);
    if (!boundary.solid) return nullptr;
    return std::make_shared<const DepthSolid>(boundary.solid, first.X_BG, boundary.deviation);
  }
  Boundary all = unionOf(elements, pool, false), inner;
  if (!all.solid) return nullptr;
  if (std::any_of(elements.begin(), elements.end(), [](const auto* element) { return isRound(*element); })) {
    inner = unionOf(elements, pool, true);
    if (!inner.solid) return nullptr;
  }
  return std::make_shared<const DepthSolid>(std::move(all.solid), Isometry3d::Identity(),
                                            std::max(all.deviation, inner.deviation), std::move(inner.solid));
}

}  // namespace

std::shared_ptr<const DepthSolid> solidOf(const BodyDescription& description, MeshPool& pool) {
  WeakStore<DepthSolid>& shared = pool.content().solids;
  const std::string key = pool.keys().keyOf(description);
  if (auto known = shared.find(key)) return known;
  auto made = ownSolidOf(description, pool);
  return made ? shared.keep(key, std::move(made)) : nullptr;
}

}  // namespace sdf_ccd
