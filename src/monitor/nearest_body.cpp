#include "sdf_ccd/monitor.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/infinity.h"
#include "monitor/nearest_body.h"
#include "scene/mesh_distance.h"
#include "scene/union_depth.h"
#include "surface/depth_solid.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxTriangles = 500'000;  // of a mesh without a field, which take up to 0.5 GB

using MeshPointer = std::shared_ptr<const TriangleMesh>;
using SolidPointer = std::shared_ptr<const DepthSolid>;

/// Of a body as a whole; null if it has none that is certain. A single primitive is more exact by its formula.
SolidPointer exactSolidOf(const Body& body, const BodyDescription& description) {
  const bool is_primitive =
      description.geometry.size() == 1 && std::holds_alternative<Primitive>(description.geometry.front().shape);
  return is_primitive || !body.half_spaces.empty() || body.inside_is_doubtful ? nullptr : body.solid;
}

/// Whether a field has to tell, as the triangles are too many.
bool needsField(const BodyDescription& description) {
  const auto isLarge = [](const GeometryDescription& geometry) {
    const auto* mesh = std::get_if<MeshPointer>(&geometry.shape);
    return mesh && (*mesh)->triangles.size() > kMaxTriangles;
  };
  return std::any_of(description.geometry.begin(), description.geometry.end(), isLarge);
}

/// Its gradient is in the frame of the body.
FieldSample sampleOf(const DepthSolid& solid, const Vector3d& p_B) {
  constexpr double kRounding = 1e-12;
  const Vector3d p_G = solid.X_BG().inverse() * p_B;
  const PointDepth depth = solid.at(p_G);
  FieldSample sample;
  sample.value = -depth.depth;
  sample.gradient = solid.X_BG().linear() * depth.out;
  sample.error = solid.deviation() + kRounding * (std::abs(depth.depth) + p_B.norm());
  if (depth.depth > 0.0) sample.error += depth.depth - solid.leastDepth(p_G, depth.depth);
  return sample;
}

}  // namespace

class MeshDistances {
 public:
  /// Releases what was prepared of meshes that are gone.
  void dropUnused() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto known = known_.begin(); known != known_.end();)
      known = known->second.mesh.expired() ? known_.erase(known) : std::next(known);
  }

  /// @throws std::invalid_argument as MeshDistance().
  std::shared_ptr<const MeshDistance> find(const GeometryDescription& geometry) {
    const MeshPointer& mesh = std::get<MeshPointer>(geometry.shape);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto known = known_.find(mesh.get());
      if (known != known_.end() && known->second.mesh.lock() == mesh) return known->second.distance;
    }
    auto made = std::make_shared<const MeshDistance>(geometry);
    const std::lock_guard<std::mutex> lock(mutex_);
    known_[mesh.get()] = {mesh, made};
    return made;
  }

 private:
  struct Known {
    std::weak_ptr<const TriangleMesh> mesh;
    std::shared_ptr<const MeshDistance> distance;
  };
  std::mutex mutex_;
  std::unordered_map<const TriangleMesh*, Known> known_;  // guarded by mutex_
};

std::shared_ptr<MeshDistances> makeMeshDistances() {
  return std::make_shared<MeshDistances>();
}

void dropUnused(MeshDistances& meshes) {
  meshes.dropUnused();
}

/// One element of a body: a primitive, a mesh, a field, or a box that contains what is not known.
class NearestBodySearch::Element {
 public:
  Element(const Isometry3d& X_BG, const AlignedBox3d& box) : X_BG_(X_BG), X_GB_(X_BG.inverse()), source_(box) {}
  Element(const Isometry3d& X_BG, DistanceField field)
      : X_BG_(X_BG), X_GB_(X_BG.inverse()), source_(std::move(field)) {}
  Element(const Isometry3d& X_BG, std::shared_ptr<const MeshDistance> mesh)
      : X_BG_(X_BG), X_GB_(X_BG.inverse()), source_(std::move(mesh)) {}

  Vector3d toElement(const Vector3d& p_B) const { return X_GB_ * p_B; }

  /// Whether nothing but lowerBound() is known.
  bool isUnknown() const { return std::holds_alternative<AlignedBox3d>(source_); }

  double lowerBound(const Vector3d& p_G) const {
    if (const auto* box = std::get_if<AlignedBox3d>(&source_))
      return signedDistance(Box::fromSize(box->sizes()), p_G - box->center());
    if (const auto* field = std::get_if<DistanceField>(&source_)) return field->lowerBound(p_G);
    return std::get<MeshDistancePointer>(source_)->lowerBound(p_G);
  }

  PartExtent extent() const {
    if (const auto* box = std::get_if<AlignedBox3d>(&source_)) return {X_BG_, *box};
    if (const auto* field = std::get_if<DistanceField>(&source_)) return extentOf(X_BG_, *field);
    return {X_BG_, std::get<MeshDistancePointer>(source_)->box()};
  }

  /// Its gradient is in the frame of the body.
  FieldSample sample(const Vector3d& p_G) const {
    const auto* field = std::get_if<DistanceField>(&source_);
    FieldSample sample = field ? field->meshSample(p_G) : std::get<MeshDistancePointer>(source_)->sample(p_G);
    sample.gradient = X_GB_.linear().transpose() * sample.gradient;
    return sample;
  }

 private:
  using MeshDistancePointer = std::shared_ptr<const MeshDistance>;

  Isometry3d X_BG_, X_GB_;
  std::variant<DistanceField, MeshDistancePointer, AlignedBox3d> source_;
};

NearestBodySearch::NearestBodySearch(std::shared_ptr<const Scene> scene,
                                     std::shared_ptr<const SceneDescription> description,
                                     std::shared_ptr<MeshDistances> meshes, bool approximate)
    : scene_(std::move(scene)),
      description_(std::move(description)),
      meshes_(meshes ? std::move(meshes) : makeMeshDistances()),
      approximate_(approximate),
      solids_(scene_->bodies.size()),
      elements_(scene_->bodies.size()) {
  meshes_->dropUnused();
}

NearestBodySearch::~NearestBodySearch() = default;

std::string NearestBodySearch::prepare(std::size_t body) {
  const Body& ready = scene_->bodies[body];
  const BodyDescription& description = description_->bodies[body];
  std::vector<Element> elements;
  std::string doubts;
  if (!ready.failure.empty()) return "ignored: " + ready.failure;
  if (approximate_ || needsField(description)) {
    for (const BodyPart& part : ready.parts) elements.emplace_back(part.X_BG, part.field);
  }
  if (!elements.empty()) {
    elements_[body] = std::move(elements);
    return ready.warning;
  }
  solids_[body] = exactSolidOf(ready, description);
  if (solids_[body]) return ready.warning;
  for (const GeometryDescription& geometry : description.geometry) {
    if (const auto* primitive = std::get_if<Primitive>(&geometry.shape)) {
      elements.emplace_back(geometry.X_BG, DistanceField(*primitive));
      continue;
    }
    const TriangleMesh& mesh = *std::get<MeshPointer>(geometry.shape);
    std::string doubt;
    if (mesh.triangles.size() > kMaxTriangles) {
      doubt = fmt::format("ignored but for its box, which errors allow for: {} has {} triangles and no field",
                          geometry.source, mesh.triangles.size());
      elements.emplace_back(geometry.X_BG, boundingBox(mesh));
    } else {
      try {
        const std::shared_ptr<const MeshDistance> distance = meshes_->find(geometry);
        elements.emplace_back(geometry.X_BG, distance);
        doubt = distance->warning();
      } catch (const std::exception& error) {
        return fmt::format("ignored: {}: {}", geometry.source, error.what());
      }
    }
    if (!doubt.empty()) doubts += (doubts.empty() ? "" : "; ") + doubt;
  }
  elements_[body] = std::move(elements);
  return doubts;
}

bool NearestBodySearch::isIgnored(std::size_t body) const {
  return !solids_[body] && elements_[body].empty();
}

/// Upper bound of a point's depth in the union of a body's elements [m]; of one that is outside, minus infinity.
double NearestBodySearch::greatestDepth(const std::vector<Element>& elements, const Vector3d& p_B) {
  if (elements.size() < 2) return -kInfinity;
  const auto lowOf = [&](const Element& element) {
    const Vector3d p_G = element.toElement(p_B);
    const double low = element.lowerBound(p_G);
    if (low > 0.0 || element.isUnknown()) return low;
    const FieldSample sample = element.sample(p_G);
    return std::max(low, sample.value - sample.error);
  };
  double least = kInfinity;
  for (const Element& element : elements) least = std::min(least, lowOf(element));
  if (least > kTouchingParts) return -kInfinity;
  const double depth = std::max(0.0, -least);
  // If no other element is as near, the nearest location outside is that of this element.
  const auto near = std::count_if(elements.begin(), elements.end(),
                                  [&](const Element& element) { return lowOf(element) <= depth + kTouchingParts; });
  if (near < 2) return -kInfinity;
  return std::max(depth, boundOfUnionDepth(
                             elements.size(), [&](std::size_t i) { return elements[i].extent(); }, p_B));
}

NearestBody NearestBodySearch::nearest(const std::vector<Isometry3d>& X_WB, const Vector3d& p_W) const {
  NearestBody nearest;
  nearest.distance = kInfinity;
  double low = kInfinity;  // lower bound of all distances
  for (std::size_t b = 0; b < elements_.size(); ++b) {
    if (isIgnored(b)) continue;
    const Matrix3d& R_WB = X_WB[b].linear();
    const Vector3d p_B = R_WB.transpose() * (p_W - X_WB[b].translation());
    const auto offer = [&](const FieldSample& sample) {
      low = std::min(low, sample.value - sample.error);
      if (!(sample.value < nearest.distance)) return;
      nearest = {static_cast<int>(b), sample.value, sample.error, R_WB * sample.gradient};
    };
    if (const DepthSolid* const solid = solids_[b].get()) {
      const double at_least = solid->distanceBound(solid->X_BG().inverse() * p_B) - solid->deviation();
      if (!(at_least > nearest.distance)) offer(sampleOf(*solid, p_B));
      continue;
    }
    for (const Element& element : elements_[b]) {
      const Vector3d p_G = element.toElement(p_B);
      const double at_least = element.lowerBound(p_G);
      if (element.isUnknown()) low = std::min(low, at_least);
      if (!element.isUnknown() && !(at_least > nearest.distance)) offer(element.sample(p_G));
    }
    low = std::min(low, -greatestDepth(elements_[b], p_B));
  }
  if (nearest.body < 0) {  // there is no body, unless it is one of which only the box is known
    nearest = {};
    nearest.error = low < kInfinity ? kInfinity : 0.0;
    return nearest;
  }
  // Another body with a larger error may in truth be nearer.
  nearest.error = std::max(nearest.error, nearest.distance - low);
  return nearest;
}

}  // namespace sdf_ccd
