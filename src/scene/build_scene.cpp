#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <unordered_map>

#include "body_shell.h"
#include "coarsen.h"
#include "mesh_pool.h"
#include "pair_bound.h"
#include "sdf_ccd/field/sparse_grid.h"
#include "sdf_ccd/geometry/cancel.h"
#include "sdf_ccd/geometry/number_text.h"
#include "sdf_ccd/scene/sample_motion.h"
#include "sdf_ccd/scene/scene.h"
#include "sdf_ccd/scene/scene_cost.h"
#include "sdf_ccd/shell/contact_gap.h"
#include "sdf_ccd/shell/witness_points.h"
#include "surface_crossing.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

std::string nameOf(const Primitive& primitive) {
  static const char* const kNames[] = {"sphere", "box", "cylinder", "half-space"};
  return kNames[primitive.index()];
}

std::string nameOf(const PooledMesh& mesh) {
  const std::string count = std::to_string(mesh.mesh.triangles.size()) + " triangles";
  if (mesh.voxels) return "voxels (" + count + ")";
  return "mesh (" + count + (mesh.quality.sign_trusted ? ", closed)" : ", open)");
}

/// Builds one body after the other from the shared pool of meshes.
class BodyBuilder {
 public:
  BodyBuilder(const BodyDescription& description, const SceneOptions& options, MeshPool& pool, BodyReport& report)
      : description_(description), options_(options), pool_(pool), report_(report) {
    for (const GeometryDescription& geometry : description.geometry) {
      const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
      if (mesh && !*mesh) throw std::invalid_argument(geometry.source + ": no mesh");
      meshes_.push_back(mesh ? &pool.find(geometry) : nullptr);
      const std::string name = meshes_.back() ? nameOf(*meshes_.back()) : nameOf(primitiveOf(geometry));
      report.geometry += (report.geometry.empty() ? "" : ", ") + name;
      const std::string doubt = mesh && !geometry.watertight_voxels ? warningOf(meshes_.back()->quality) : "";
      if (doubt.empty()) continue;
      report.warnings.push_back(geometry.source + ": " + doubt + ": " + summary(meshes_.back()->quality));
      warning_ += (warning_.empty() ? "" : "; ") + geometry.source + ": " + doubt;
    }
    if (description.geometry.size() > 3) report.geometry = std::to_string(description.geometry.size()) + " parts";
  }

  const std::string& warning() const { return warning_; }

  std::vector<BodyPart> makeParts(const Progress& progress) {
    std::vector<BodyPart> parts;
    bool exact = true, built = false, cached = false;
    const auto start = Clock::now();
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      const GeometryDescription& geometry = description_.geometry[i];
      if (!meshes_[i]) {
        parts.push_back({geometry.X_BG, DistanceField(primitiveOf(geometry))});
        report_.field_bytes += parts.back().field.bytes();
        continue;
      }
      const MeshPool::Made made = pool_.makeField(*meshes_[i], [&](double share) {
        if (progress) progress((double(i) + share) / double(meshes_.size()));
      });
      parts.push_back({geometry.X_BG, *meshes_[i]->field});
      const DistanceField& field = parts.back().field;
      exact = false;
      built |= made.now && !made.outcome.from_cache;
      cached |= made.outcome.from_cache;
      if (made.now) report_.field_bytes += field.bytes();
      report_.cells += field.cells();
      report_.field_error = std::max(report_.field_error, field.errorBound());
      note(made.outcome);
      noteCaps(geometry, *meshes_[i]);
      const std::string left_out = made.now && meshes_[i]->made.solid ? summary(meshes_[i]->made.solid->report()) : "";
      if (!left_out.empty()) report_.solid += (report_.solid.empty() ? "" : "; ") + left_out;
    }
    char text[32];
    std::snprintf(text, sizeof(text), "built %.1f s", std::chrono::duration<double>(Clock::now() - start).count());
    report_.field = exact ? "exact" : built ? text : cached ? "cached" : "shared";
    return parts;
  }

  /// @param edges_only  the body is one box, whose faces get no points.
  PointShell makeShell(const std::vector<BodyPart>& parts, bool edges_only) {
    std::vector<DistanceField> primitives;  // exact fields cost nothing, so siblings have them in any case
    primitives.reserve(meshes_.size());
    std::vector<ShellPart> shells;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      const GeometryDescription& geometry = description_.geometry[i];
      if (!meshes_[i]) {
        const Primitive& primitive = primitiveOf(geometry);
        primitives.emplace_back(primitive);
        shells.push_back({geometry.X_BG, makeShell(primitive, edges_only), &primitives.back()});
      } else {
        note(pool_.makeShell(*meshes_[i], hasSiblings()).outcome);
        const bool known = !parts.empty() && meshes_[i]->quality.sign_trusted;
        shells.push_back({geometry.X_BG, *meshes_[i]->shells[hasSiblings()], known ? &*meshes_[i]->field : nullptr});
      }
    }
    return unionShell(shells);
  }

  /// Of all geometry but half-spaces, which lie inside no body.
  PointShell makeWitnesses() const {
    PointShell all;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      if (isHalfSpace(description_.geometry[i])) continue;
      const PointShell part =
          witnessPoints(meshes_[i] ? meshes_[i]->mesh : coarse(primitiveOf(description_.geometry[i])));
      all.covering_radius = part.covering_radius;
      all.areas.insert(all.areas.end(), part.areas.begin(), part.areas.end());
      const Isometry3d& X_BG = description_.geometry[i].X_BG;
      for (const Vector3d& p_G : part.points) all.points.push_back(X_BG * p_G);
      for (const Vector3d& normal_G : part.normals) all.normals.push_back(X_BG.linear() * normal_G);
    }
    return all;
  }

 private:
  PointShell makeShell(const Primitive& primitive, bool edges_only) {
    ShellOptions options = options_.shell;
    options.has_siblings = hasSiblings();
    std::string warning;
    const auto make = [&](double gap) {
      options.edge_gap = gap;
      options.spacing = std::max(options.spacing, gap);
      if (edges_only) return sampleEdges(tessellate(primitive, gap), options);  // a box, which is its tessellation
      return sampleSurface(primitive, options);
    };
    PointShell shell = makeCoarser(options.edge_gap, options_.max_error.has_value(), make, warning);
    if (!warning.empty()) report_.warnings.push_back(warning);
    return shell;
  }

  /// With vertices on its surface.
  static TriangleMesh coarse(const Primitive& primitive) {
    return tessellate(primitive, 0.1 * boundingBox(primitive).sizes().maxCoeff());
  }

  bool hasSiblings() const { return meshes_.size() > 1; }

  static const Primitive& primitiveOf(const GeometryDescription& geometry) {
    return std::get<Primitive>(geometry.shape);
  }

  /// Says what closes an open mesh.
  void noteCaps(const GeometryDescription& geometry, const PooledMesh& mesh) {
    const OpeningCaps* caps = mesh.field->openings();
    if (!caps) return;
    report_.warnings.push_back(geometry.source + ": caps of " + numberText(surfaceArea(caps->mesh())) +
                               " m^2 close it, and CONTACT with it needs surfaces that cross");
  }

  void note(const CacheOutcome& outcome) {
    if (!outcome.warning.empty()) report_.warnings.push_back(outcome.warning);
  }

  const BodyDescription& description_;
  const SceneOptions& options_;
  MeshPool& pool_;
  BodyReport& report_;
  std::vector<PooledMesh*> meshes_;  // per geometry; null for a primitive
  std::string warning_;
};

/// The triangles of a body's geometry; null where it has none.
std::shared_ptr<const BodySurface> surfaceOf(const BodyDescription& description, MeshPool& pool) {
  // Deviation of a primitive's triangles, over its least size, and over its largest: a disc of no thickness has one
  // too.
  constexpr double kFineOfSize = 1e-3, kFineOfLargest = 1e-6;
  TriangleMesh all;
  double deviation = 0.0;
  for (const GeometryDescription& geometry : description.geometry) {
    TriangleMesh part;
    if (const auto* primitive = std::get_if<Primitive>(&geometry.shape)) {
      if (isHalfSpace(*primitive)) continue;
      const Vector3d size = boundingBox(*primitive).sizes();
      const double fine = std::max(kFineOfSize * size.minCoeff(), kFineOfLargest * size.maxCoeff());
      if (!std::holds_alternative<Box>(*primitive)) deviation = std::max(deviation, fine);
      part = tessellate(*primitive, fine);
    } else {
      part = pool.find(geometry).mesh;
    }
    all = merged(std::move(all), transformed(std::move(part), geometry.X_BG));
  }
  if (all.triangles.empty()) return nullptr;
  return std::make_shared<const BodySurface>(std::move(all), deviation);
}

/// What the plan has for one body.
struct Needs {
  bool field, shell, edges_only, witnesses;
};

/// The shell's points span the surface's hull, where that is not curved; to nowhere on it is it farther from one of
/// them than the covering radius (of edges alone, which have none, the corners span it).
BoundingBall surfaceBall(const Body& body) {
  if (body.shell.size() == 0) return motionBall(body);
  BoundingBall ball = boundingBall(body.shell);
  if (std::isfinite(body.shell.covering_radius)) ball.radius += body.shell.covering_radius;
  return ball;
}

/// How far building all bodies has come, by what each is expected to take.
class Pace {
 public:
  Pace(const SceneDescription& description, const SceneCost* expected) {
    constexpr double kLeast = 1e-3;  // of any body [s]
    std::unordered_map<std::string, const BodyCost*> costs;
    if (expected)
      for (const BodyCost& cost : expected->bodies) costs[cost.name] = &cost;
    for (const BodyDescription& body : description.bodies) {
      const auto found = costs.find(body.name);
      const bool known = found != costs.end();
      fields_.push_back(known ? found->second->field_seconds : expected ? 0.0 : 1.0);
      before_.push_back(all_);
      all_ += (known ? found->second->seconds : fields_.back()) + kLeast;
    }
  }

  /// When this share of a body's fields is done.
  double done(std::size_t body, double share) const { return (before_[body] + share * fields_[body]) / all_; }

 private:
  std::vector<double> fields_, before_;  ///< per body [s]
  double all_ = 0.0;
};

void build(const Needs& needs, BodyBuilder&& builder, const Progress& progress, Body& body, BodyReport& report) {
  body.warning = builder.warning();
  if (needs.field) body.parts = builder.makeParts(progress);
  if (needs.witnesses) body.witnesses = builder.makeWitnesses();
  if (needs.witnesses) body.witness_tree = buildSphereTree(body.witnesses);
  if (needs.shell) body.shell = builder.makeShell(body.parts, needs.edges_only);
  report.witnesses = body.witnesses.size();
  body.ball = surfaceBall(body);
  if (!needs.shell) return;
  body.tree = buildSphereTree(body.shell);
  report.shell_points = body.shell.size();
  report.shell_bytes =
      body.shell.size() * (2 * sizeof(Vector3d) + sizeof(double)) + body.tree.nodes.size() * sizeof(SphereTree::Node);
  report.gap = contactGap(body.shell, body.shell);
}

bool isLarger(const ErrorBound& a, const ErrorBound& b) {
  return a.total() > b.total();
}

void setBounds(const SceneOptions& options, Scene& scene) {
  for (const PlannedPair& pair : scene.pairs) {
    ErrorBound bound = pairBound(scene, pair);
    if (bound.total() == 0.0) continue;  // of a body that was not built
    bound.chord = options.motion_margin;
    for (ErrorBound* largest : {&scene.reports[pair.body_a].bound, &scene.reports[pair.body_b].bound, &scene.bound})
      if (isLarger(bound, *largest)) *largest = bound;
  }
}

}  // namespace

Scene buildScene(const SceneDescription& description, const ScenePlan& plan, const SceneOptions& options,
                 const std::function<void(const std::string&, double)>& progress) {
  const auto start = Clock::now();
  Scene scene;
  scene.max_error = options.max_error;
  scene.pairs = plan.pairs;
  scene.left_out = plan.left_out;
  scene.visual_only = description.visual_only;
  const std::shared_ptr<MeshPool> pool =
      plan.expected && plan.expected->meshes ? plan.expected->meshes : std::make_shared<MeshPool>(options);
  const std::size_t count = description.bodies.size();
  const Pace pace(description, plan.expected.get());
  for (std::size_t i = 0; i < count; ++i) {
    const BodyDescription& described = description.bodies[i];
    Body body;
    body.name = described.name;
    body.frame = described.frame;
    body.X_frame_B = described.X_frame_B;
    body.is_world = described.is_world;
    body.failure = described.failure;
    BodyReport report;
    report.name = described.name;
    report.field = "left out";
    report.pairs = std::count_if(plan.pairs.begin(), plan.pairs.end(), [&](const PlannedPair& pair) {
      return pair.body_a == static_cast<int>(i) || pair.body_b == static_cast<int>(i);
    });
    checkCancelled();
    const auto report_progress = [&](double share) {
      if (progress) progress(described.name, pace.done(i, share));
    };
    report_progress(0.0);
    if (body.failure.empty() && (plan.needs_field[i] || plan.needs_shell[i] || plan.needs_witnesses[i])) {
      try {
        build({plan.needs_field[i], plan.needs_shell[i], plan.edges_only[i], plan.needs_witnesses[i]},
              BodyBuilder(described, options, *pool, report), report_progress, body, report);
      } catch (const std::exception& error) {
        body.failure = error.what();
        body.parts.clear();
        body.shell = body.witnesses = {};
        body.tree = body.witness_tree = {};
      }
    }
    if (!body.failure.empty()) report.field = "failed";
    scene.bodies.push_back(std::move(body));
    scene.reports.push_back(std::move(report));
  }
  for (const PlannedPair& pair : scene.pairs) {
    if (!hasOpenings(scene.bodies[pair.body_a]) && !hasOpenings(scene.bodies[pair.body_b])) continue;
    for (const int i : {pair.body_a, pair.body_b}) {
      Body& body = scene.bodies[i];
      if (body.failure.empty() && !body.surface) body.surface = surfaceOf(description.bodies[i], *pool);
    }
  }
  if (progress && count > 0) progress(description.bodies.back().name, 1.0);
  setBounds(options, scene);
  scene.build_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return scene;
}

}  // namespace sdf_ccd
