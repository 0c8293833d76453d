#include "scene_cost.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "body/body_builder.h"
#include "body/element_options.h"
#include "body/mesh_pool.h"
#include "common/number_text.h"
#include "field/field_cache.h"
#include "field/source_field.h"
#include "geometry/unit_hint.h"
#include "shell/sample_surface.h"

namespace sdf_ccd {
namespace {

constexpr double kSecondsPerPoint = 3.5e-5;  // on one thread; measured on shells of robot links
// Including its share of the sphere tree: two nodes for a leaf of more than half the points that it may have.
constexpr double kBytesPerPoint = double(PointShell::kBytesPerPoint) + 2.0 * sizeof(SphereTree::Node) / 8.0;
constexpr double kSecondsPerTriangle = 4e-6;
constexpr double kBytesPerTriangle = 120.0;  // including its share of the box tree
constexpr double kLeftOfVoxels = 0.36;       // of a map's triangles, when faces are joined to rectangles
constexpr double kFinestOfSize = 2e-3;       // gap for which a curved primitive is tessellated, relative to its size
constexpr double kUncertain = 0.35;          // relative standard error; twice this is less than a factor of two
constexpr double kHopeless = 2.0;            // excess over the limit from which affordableCost() refuses a field

/// Time on the threads available in the caller's TBB arena.
double onThreads(double one_thread) {
  using tbb::global_control;
  const auto max_threads = static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
  return one_thread / std::max(1, std::min(max_threads, tbb::this_task_arena::max_concurrency()));
}

/// Size of the field's cache file [bytes]; 0 if there is none.
double cachedBytes(const BodyOptions& options, const TriangleMesh& mesh, const FieldOptions& field) {
  if (options.cache_directory.empty()) return 0.0;
  std::error_code missing;
  const auto bytes = std::filesystem::file_size(options.cache_directory + "/" + fieldFileName(mesh, field), missing);
  return missing ? 0.0 : static_cast<double>(bytes);
}

class CostEstimate {
 public:
  explicit CostEstimate(const BodyOptions& options) : options_(options), pool_(std::make_shared<MeshPool>(options)) {}

  std::shared_ptr<MeshPool> meshes() const { return pool_; }

  BodyCost of(const BodyDescription& body, const BodyNeeds& needs) {
    BodyCost cost;
    cost.name = body.name;
    cost.in_cache = true;
    const bool is_first = seen_bodies_.insert(pool_->keys().keyOf(body)).second;
    if (!is_first) return cost;  // shared, see buildBody()
    for (const GeometryDescription& geometry : body.geometry) {
      const auto* primitive = std::get_if<Primitive>(&geometry.shape);
      if (primitive) {
        if (needs.shell) addShell(*primitive, cost);
        continue;
      }
      PooledMesh& mesh = pool_->find(geometry);
      if (cost.hint.empty() && !geometry.watertight_voxels) cost.hint = unitHint(mesh.mesh);
      const bool is_new = seen_.insert(&mesh).second;
      if (needs.field && is_new) addField(mesh, cost);
      const double joined = geometry.watertight_voxels ? kLeftOfVoxels : 1.0;
      if (needs.triangles && is_new) cost.addTriangles(joined * double(mesh.mesh.triangles.size()));
      const bool use = body.geometry.size() > 1;
      if (needs.shell) cost.addShell(affordable(expectedPoints(mesh.mesh, pool_->shellOptions(mesh, use))));
    }
    cost.in_cache = cost.in_cache && cost.field_bytes > 0.0;
    return cost;
  }

 private:
  void addField(PooledMesh& mesh, BodyCost& cost) {
    FieldOptions field = pool_->fieldOptions(mesh);
    const double cached = cachedBytes(options_, mesh.mesh, field);
    cost.in_cache = cost.in_cache && cached > 0.0;
    cost.field_bytes += cached;
    if (cached > 0.0) return;
    const SolidSource source(mesh.mesh, mesh.made);
    FieldCost expected = expectedCost(source, field);
    cost.largest_field = std::max(cost.largest_field, expected.bytes);
    // A build that exceeds the limit ends there, and a coarser field is built instead.
    const auto max_bytes = static_cast<double>(field.max_bytes);
    double one_thread = 0.0;
    constexpr int kMaxCoarser = 40;
    for (int i = 0; i < kMaxCoarser && options_.divides_max_error && field.max_error && expected.bytes > max_bytes &&
                    expected.bytes < kHopeless * max_bytes;
         ++i) {
      one_thread += expected.seconds * max_bytes / expected.bytes;
      *field.max_error *= 2.0;
      expected = expectedCost(source, field);
    }
    expected.seconds += one_thread;
    cost.addField(expected);
  }

  /// Tessellating a curved primitive finely would cost more than its shell. So points are counted on a coarser shell
  /// and extrapolated: they grow with the square of the fineness, or the power 1.5 if rims dominate.
  void addShell(const Primitive& primitive, BodyCost& cost) {
    const double size = boundingBox(primitive).sizes().norm();
    const bool is_box = std::holds_alternative<Box>(primitive);
    const Growth growth = Growth::kFull;
    ShellOptions shell = shellOptionsFor(options_, surfaceArea(primitive), growth);
    const double finest = finenessOf(shell);
    const double coarser = is_box ? 1.0 : std::max(1.0, kFinestOfSize * size / finest);
    const bool has_rims = std::holds_alternative<Cylinder>(primitive) && shell.edge_gap > 0.0;
    shell.spacing = coarser * shell.spacing;
    shell.edge_gap *= coarser;
    const double points = expectedPoints(tessellate(primitive, 0.05 * coarser * finest), shell);
    cost.addShell(affordable(points * std::pow(coarser, has_rims ? 1.5 : 2.0)));
  }

  /// Where fineness follows the bodies' sizes, a shell that would have too many points is made with a coarser one.
  double affordable(double points) const {
    const auto most = static_cast<double>(options_.shell.max_points);
    while (options_.points_across > 0.0 && most > 0.0 && points > most) points *= 0.25;
    return points;
  }

  const BodyOptions& options_;
  std::shared_ptr<MeshPool> pool_;
  std::set<const PooledMesh*> seen_;
  std::set<std::string> seen_bodies_;  // keys of their content
};

std::string about(double bytes, double seconds) {
  return memoryText(bytes) + " and " + durationText(seconds);
}

}  // namespace

void BodyCost::addField(const FieldCost& field) {
  const double taken = onThreads(field.seconds);
  uncertain |= std::max(field.bytes_error, field.seconds_error) > kUncertain;
  field_bytes += field.bytes;
  largest_field = std::max(largest_field, field.bytes);
  field_seconds += taken;
  seconds += taken;
}

void BodyCost::addShell(double points) {
  shell_points += points;
  largest_shell = std::max(largest_shell, points);
  shell_bytes += kBytesPerPoint * points;
  if (!in_cache || field_bytes == 0.0) seconds += kSecondsPerPoint * points;
}

void BodyCost::addTriangles(double count) {
  shell_bytes += kBytesPerTriangle * count;
  seconds += kSecondsPerTriangle * count;
}

void SceneCost::add(const BodyCost& body) {
  bytes += body.field_bytes + body.shell_bytes;
  seconds += body.seconds;
  bodies.push_back(body);
}

SceneCost expectedCost(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options) {
  SceneCost scene;
  CostEstimate estimate(options);
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    const BodyDescription& body = description.bodies[i];
    if (!body.failure.empty() || !(plan.needs[i].field || plan.needs[i].shell)) continue;
    try {
      scene.add(estimate.meshes()->withinTime(body, [&] { return estimate.of(body, plan.needs[i]); }));
    } catch (const std::exception&) {
      // Building the body will report the error.
    }
  }
  scene.meshes = estimate.meshes();
  return scene;
}

std::string summary(const SceneCost& cost) {
  std::string text = "about " + about(cost.bytes, cost.seconds) + " to build";
  const auto largest =
      std::max_element(cost.bodies.begin(), cost.bodies.end(), [](const BodyCost& a, const BodyCost& b) {
        return a.field_bytes + a.shell_bytes < b.field_bytes + b.shell_bytes;
      });
  if (largest == cost.bodies.end()) return text;
  text += "; most for " + largest->name + ": " + about(largest->field_bytes + largest->shell_bytes, largest->seconds);
  if (!largest->hint.empty()) text += " (" + largest->hint + ")";
  std::string uncertain;
  for (const BodyCost& body : cost.bodies)
    if (body.uncertain) uncertain += (uncertain.empty() ? "" : ", ") + body.name;
  return uncertain.empty() ? text : text + "; may be off by more than a factor of two for " + uncertain;
}

}  // namespace sdf_ccd
