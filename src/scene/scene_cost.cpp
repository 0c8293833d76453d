#include "sdf_ccd/scene/scene_cost.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

#include <tbb/task_arena.h>

#include "mesh_pool.h"
#include "sdf_ccd/field/field_cache.h"

namespace sdf_ccd {
namespace {

// Measured on 77 meshes of UR5, Kinova, Fanuc and PR2 at 1e-3 of their sizes, one thread (the study `meshes`). Flat
// surfaces take a third of these bytes, those with many edges and curves up to three times as many. Where the sides of
// triangles are not certain, a winding number is asked for at each sample.
constexpr double kBytesPerCell = 0.66;                                  // a cell: of the surface, error²
constexpr double kSecondsPerByte = 0.7e-6, kSecondsPerCutByte = 40e-6;  // the latter where all triangles are doubtful
constexpr double kLeastBytes = 5e4;
constexpr double kSecondsPerSample = 0.5e-6;  // of a grid of even cells
constexpr double kSecondsPerPoint = 3.5e-5;   // of a shell
constexpr double kBytesPerPoint = 88.0;       // with its share of the sphere tree
constexpr double kFinestOfSize = 2e-3;        // gap that a curved primitive is tessellated for, over its size

double seconds(double one_thread) {
  return one_thread / std::max(1, tbb::this_task_arena::max_concurrency());
}

/// Whole bricks that a band about a surface meets.
double evenSamples(const TriangleMesh& mesh, double cell, double band) {
  const double brick = GridShape::kBrick * cell;
  const double layers = 2.0 * (std::max(band, 2.0 * cell) + cell) + brick;
  return surfaceArea(mesh) * layers / (brick * brick * brick) * GridShape::kSamples;
}

/// Share of the surface whose triangles do not tell the inside from the outside by themselves.
/// Of an open mesh, whose field is that of the mesh closed by caps, none.
double doubtfulShare(const Solid& solid) {
  if (!solid.closed()) return 0.0;
  const TriangleMesh& mesh = solid.boundary();
  const std::vector<std::uint8_t>& separates = solid.separates();
  double area = 0.0;
  for (std::size_t i = 0; i < separates.size(); ++i)
    if (!separates[i]) area += 0.5 * areaNormal(mesh, static_cast<int>(i)).norm();
  return area / surfaceArea(mesh);
}

/// Of a field that the cache has; 0 if it has not [bytes].
double cachedBytes(const SceneOptions& options, const TriangleMesh& mesh, const FieldOptions& field) {
  if (options.cache_directory.empty()) return 0.0;
  std::error_code missing;
  const auto bytes = std::filesystem::file_size(options.cache_directory + "/" + fieldFileName(mesh, field), missing);
  return missing ? 0.0 : static_cast<double>(bytes);
}

class CostEstimate {
 public:
  explicit CostEstimate(const SceneOptions& options) : options_(options), pool_(options) {}

  BodyCost of(const BodyDescription& body, bool needs_field, bool needs_shell, bool edges_only) {
    BodyCost cost;
    cost.name = body.name;
    cost.in_cache = true;
    for (const GeometryDescription& geometry : body.geometry) {
      const auto* primitive = std::get_if<Primitive>(&geometry.shape);
      if (primitive) {
        if (needs_shell) addShell(*primitive, edges_only, cost);
        continue;
      }
      PooledMesh& mesh = pool_.find(geometry);
      const bool is_new = seen_.insert(&mesh).second;
      if (needs_field && is_new) addField(mesh, cost);
      if (needs_shell) addPoints(expectedPoints(mesh.mesh, options_.shell), cost);
    }
    cost.in_cache = cost.in_cache && cost.field_bytes > 0.0;
    return cost;
  }

 private:
  double finest() const { return options_.shell.edge_gap > 0.0 ? options_.shell.edge_gap : options_.shell.spacing; }

  void addField(PooledMesh& mesh, BodyCost& cost) {
    const FieldOptions field = pool_.fieldOptions(mesh);
    const double cached = cachedBytes(options_, mesh.mesh, field);
    cost.in_cache = cost.in_cache && cached > 0.0;
    cost.field_bytes += cached;
    if (cached > 0.0) return;
    double bytes = 0.0, one_thread = 0.0;
    if (field.max_error) {
      const Solid& solid = SolidSource(mesh.mesh, mesh.solid).solid();
      const double doubtful = doubtfulShare(solid);
      const double cells = surfaceArea(solid.boundary()) / (*field.max_error * *field.max_error);
      bytes = kLeastBytes + kBytesPerCell * cells;
      one_thread = (kSecondsPerByte + doubtful * kSecondsPerCutByte) * bytes;
    } else {
      const double cell = field.cell_size ? *field.cell_size : boundingBox(mesh.mesh).sizes().maxCoeff() / *field.cells;
      const double samples = evenSamples(mesh.mesh, cell, field.band);
      bytes = samples * field.sample_bits / 8.0;
      one_thread = kSecondsPerSample * samples;
    }
    cost.field_bytes += bytes;
    cost.largest_field = std::max(cost.largest_field, bytes);
    cost.seconds += seconds(one_thread);
  }

  /// A finely tessellated curve would cost more than its shell: points of a coarser one stand for it, and grow as they
  /// do on such surfaces.
  void addShell(const Primitive& primitive, bool edges_only, BodyCost& cost) {
    const double size = boundingBox(primitive).sizes().norm();
    const bool is_box = std::holds_alternative<Box>(primitive);
    const double coarser = is_box ? 1.0 : std::max(1.0, kFinestOfSize * size / finest());
    const bool has_rims = std::holds_alternative<Cylinder>(primitive) && options_.shell.edge_gap > 0.0;
    ShellOptions shell = options_.shell;
    shell.spacing = edges_only ? size : coarser * shell.spacing;
    shell.edge_gap *= coarser;
    const double points = expectedPoints(tessellate(primitive, 0.05 * coarser * finest()), shell);
    addPoints(points * std::pow(coarser, has_rims ? 1.5 : 2.0), cost);
  }

  void addPoints(double points, BodyCost& cost) {
    cost.shell_points += points;
    cost.largest_shell = std::max(cost.largest_shell, points);
    cost.shell_bytes += kBytesPerPoint * points;
    if (!cost.in_cache || cost.field_bytes == 0.0) cost.seconds += kSecondsPerPoint * points;
  }

  const SceneOptions& options_;
  MeshPool pool_;
  std::set<const PooledMesh*> seen_;
};

std::string about(double bytes, double seconds) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g MB and %.2g s", 1e-6 * bytes, seconds);
  return text;
}

}  // namespace

SceneCost expectedCost(const SceneDescription& description, const ScenePlan& plan, const SceneOptions& options) {
  SceneCost scene;
  CostEstimate estimate(options);
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    const BodyDescription& body = description.bodies[i];
    if (!body.failure.empty() || !(plan.needs_field[i] || plan.needs_shell[i])) continue;
    try {
      const BodyCost cost = estimate.of(body, plan.needs_field[i], plan.needs_shell[i], plan.edges_only[i]);
      scene.bytes += cost.field_bytes + cost.shell_bytes;
      scene.seconds += cost.seconds;
      scene.bodies.push_back(cost);
    } catch (const std::exception&) {
      // Building the body will say what is wrong with it.
    }
  }
  return scene;
}

std::string summary(const SceneCost& cost) {
  std::string text = "about " + about(cost.bytes, cost.seconds) + " to build";
  const auto largest =
      std::max_element(cost.bodies.begin(), cost.bodies.end(), [](const BodyCost& a, const BodyCost& b) {
        return a.field_bytes + a.shell_bytes < b.field_bytes + b.shell_bytes;
      });
  if (largest == cost.bodies.end()) return text;
  return text + "; most for " + largest->name + ": " +
         about(largest->field_bytes + largest->shell_bytes, largest->seconds);
}

}  // namespace sdf_ccd
