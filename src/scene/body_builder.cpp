#include "scene/body_builder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>

#include "common/number_text.h"
#include "common/seconds_since.h"
#include "field/field_access.h"
#include "field/opening_caps.h"
#include "mesh/unit_hint.h"
#include "motion/screw_motion.h"
#include "scene/body_shell.h"
#include "scene/coarsen.h"
#include "scene/doubtful_surface.h"
#include "scene/element_options.h"
#include "shell/contact_gap.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"

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
  BodyBuilder(const BodyDescription& description, const BodyOptions& options, MeshPool& pool, BodyReport& report)
      : description_(description), options_(options), pool_(pool), report_(report) {
    for (const GeometryDescription& geometry : description.geometry) {
      const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
      if (mesh && !*mesh) throw std::invalid_argument(geometry.source + ": no mesh");
      meshes_.push_back(mesh ? &pool.find(geometry) : nullptr);
      const std::string name = meshes_.back() ? nameOf(*meshes_.back()) : nameOf(primitiveOf(geometry));
      report.geometry += (report.geometry.empty() ? "" : ", ") + name;
      if (!mesh || geometry.watertight_voxels) continue;
      if (const std::string hint = unitHint(**mesh); !hint.empty())
        report.warnings.push_back(geometry.source + ": " + hint);
      const std::string doubt = warningOf(meshes_.back()->quality);
      if (doubt.empty()) continue;
      report.warnings.push_back(geometry.source + ": " + doubt + ": " + summary(meshes_.back()->quality));
      warning_ += (warning_.empty() ? "" : "; ") + geometry.source + ": " + doubt;
    }
    if (description.geometry.size() > 3) report.geometry = std::to_string(description.geometry.size()) + " parts";
  }

  const std::string& warning() const { return warning_; }

  Doubt doubt() const { return doubtOf(description_, pool_); }

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
    const double seconds = secondsSince(start);
    report_.field = {PartState::kReady, exact    ? "exact"
                                        : built  ? "built " + durationText(seconds)
                                        : cached ? "cached"
                                                 : "shared"};
    return parts;
  }

  /// To be called before fields are built, which may take long: a shell that is too large is refused at once.
  void sampleMeshes() {
    for (PooledMesh* const mesh : meshes_)
      if (mesh) note(pool_.makeShell(*mesh, hasSiblings()).outcome);
  }

  /// @param parts  empty if no field is needed.
  PointShell makeShell(const std::vector<BodyPart>& parts) {
    std::vector<DistanceField> primitives;  // exact fields cost nothing, so siblings always have them
    primitives.reserve(meshes_.size());
    std::vector<ShellPart> shells;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      const GeometryDescription& geometry = description_.geometry[i];
      if (!meshes_[i]) {
        const Primitive& primitive = primitiveOf(geometry);
        primitives.emplace_back(primitive);
        shells.push_back({geometry.X_BG, makeShell(primitive), &primitives.back()});
      } else {
        const bool known = !parts.empty() && meshes_[i]->quality.sign_trusted;
        shells.push_back({geometry.X_BG, *meshes_[i]->shells[hasSiblings()], known ? &*meshes_[i]->field : nullptr});
      }
    }
    return unionShell(shells);
  }

 private:
  PointShell makeShell(const Primitive& primitive) {
    ShellOptions options = shellOptionsFor(options_, surfaceArea(primitive), Growth::kFull);
    options.has_siblings = hasSiblings();
    std::string warning;
    const auto make = [&](double tried) {
      setFineness(tried, options);
      return sampleSurface(primitive, options);
    };
    PointShell shell = makeCoarser(finenessOf(options), coarsestShell(options_), make, warning);
    if (!warning.empty()) report_.warnings.push_back(warning);
    return shell;
  }

  bool hasSiblings() const { return meshes_.size() > 1; }

  static const Primitive& primitiveOf(const GeometryDescription& geometry) {
    return std::get<Primitive>(geometry.shape);
  }

  /// Describes the caps that close an open mesh.
  void noteCaps(const GeometryDescription& geometry, const PooledMesh& mesh) {
    const OpeningCaps* caps = FieldAccess::openings(*mesh.field);
    if (!caps) return;
    report_.warnings.push_back(geometry.source + ": openings closed by caps of " +
                               numberText(surfaceArea(caps->mesh())) + " m^2; CONTACT requires crossing surfaces");
  }

  void note(const CacheOutcome& outcome) {
    report_.is_cache_incomplete |= outcome.is_missing;
    if (!outcome.file.empty()) report_.files.push_back(outcome.file);
    if (!outcome.warning.empty()) report_.warnings.push_back(outcome.warning);
  }

  const BodyDescription& description_;
  const BodyOptions& options_;
  MeshPool& pool_;
  BodyReport& report_;
  std::vector<PooledMesh*> meshes_;  // per geometry; null for a primitive
  std::string warning_;
};

std::vector<BodyHalfSpace> halfSpacesOf(const BodyDescription& description) {
  std::vector<BodyHalfSpace> found;
  for (const GeometryDescription& geometry : description.geometry) {
    if (!isHalfSpace(geometry)) continue;
    const DistanceField exact(std::get<Primitive>(geometry.shape));  // normalised
    const auto& half_space = std::get<HalfSpace>(*exact.primitive());
    const Vector3d& origin = geometry.X_BG.translation();
    const Vector3d normal = (geometry.X_BG.linear() * half_space.normal).normalized();
    const double rounding =
        16.0 * std::numeric_limits<double>::epsilon() * (std::abs(half_space.offset) + origin.norm());
    found.push_back({{normal, half_space.offset + normal.dot(origin)}, rounding});
  }
  return found;
}

void build(const BodyNeeds& needs, BodyBuilder&& builder, const Progress& progress, Body& body, BodyReport& report) {
  body.warning = builder.warning();
  const Doubt doubt = builder.doubt();
  body.doubtful = doubt.of_outside;
  body.inside_is_doubtful = doubt.of_inside;
  if (needs.shell) builder.sampleMeshes();
  if (needs.field) body.parts = builder.makeParts(progress);
  PointShell shell;
  if (needs.shell) shell = builder.makeShell(body.parts);
  if (needs.shell) body.tree = std::make_shared<const SphereTree>(buildSphereTree(shell));
  body.shell = std::make_shared<const PointShell>(std::move(shell));
  if (!needs.shell) return;
  report.shell.state = PartState::kReady;
  report.shell_points = body.shell->size();
  report.shell_bytes = bytesOf(*body.shell, *body.tree);
  report.gap = contactGap(*body.shell, *body.shell);
}

}  // namespace

bool hasMesh(const BodyDescription& body) {
  return std::any_of(body.geometry.begin(), body.geometry.end(), [](const GeometryDescription& geometry) {
    return !std::holds_alternative<Primitive>(geometry.shape);
  });
}

std::string whyNoShell(const BodyDescription& body) {
  for (const GeometryDescription& geometry : body.geometry) {
    if (geometry.watertight_voxels) return "a voxel map has none";
    if (isHalfSpace(geometry)) return "a half-space has no bounded surface";
  }
  return {};
}

BuiltBody failedBody(const BodyDescription& description, const std::string& failure) {
  BuiltBody failed;
  static_cast<BodyPlace&>(failed.body) = description;
  failed.body.failure = failure;
  failed.report.name = description.name;
  return failed;
}

BuiltBody buildUnshared(const BodyDescription& description, const BodyNeeds& needs, const BodyOptions& options,
                        MeshPool& pool, const Progress& progress) {
  BuiltBody built;
  Body& body = built.body;
  static_cast<BodyPlace&>(body) = description;
  built.report.name = description.name;
  if (body.failure.empty() && needs.any()) {
    try {
      requirePose(description.X_frame_B, "the body's pose in its frame");
      for (const GeometryDescription& geometry : description.geometry)
        requirePose(geometry.X_BG, "the pose of " + geometry.source);
      body.half_spaces = halfSpacesOf(description);
      build(needs, BodyBuilder(description, options, pool, built.report), progress, body, built.report);
    } catch (const std::exception& error) {
      body.failure = error.what();
      built.exceeds_limit = dynamic_cast<const std::length_error*>(&error) != nullptr;
      body.parts.clear();
      body.shell = Body().shell;
      body.tree = Body().tree;
    }
  }
  return built;
}

std::shared_ptr<const BodySurface> surfaceOf(const BodyDescription& description, MeshPool& pool) {
  // Deviation of a primitive's triangles, relative to its smallest and to its largest dimension: also defined for a
  // disc without thickness.
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

}  // namespace sdf_ccd
