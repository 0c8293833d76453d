#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/body.h"
#include "sdf_ccd/result.h"

namespace sdf_ccd {

/// A pair, and what its contacts are found with: A's shell in B's field, or the other way round, or both.
struct PlannedPair {
  int body_a;
  int body_b;
  bool a_shell_b_field;
  bool b_shell_a_field;
};

/// What a scene needs, decided before anything is built (design §4).
struct ScenePlan {
  std::vector<PlannedPair> pairs;
  std::vector<BodyNeeds> needs;  ///< per body; without surfaces, which depend on the fields once these are built
  std::vector<PairDecision> left_out;
  std::vector<PartReports> parts;  ///< per body: kReady are those that are needed
};

/// What a plan depends on besides the scene.
struct PlanOptions {
  double shell_spacing = 0.0;       ///< as in ShellOptions [m]; 0 if it does not matter
  double large_shell_points = 2e4;  ///< a primitive that needs more points gets no shell against smaller bodies
};

/// Plans which fields and shells the pairs of a scene need.
///
/// Left out are: pairs of two bodies of the world (there are many, so they are not listed), that are allowed, in the
/// same frame or rigidly joined (unless one is a tile of a map, which changes there), or of a body without geometry;
/// fields and shells that no pair uses; shells of bodies with a half-space or a voxel map among their geometry (these
/// cannot be covered with points). A body that is one large primitive (a table, a wall) only has a field against bodies
/// too small to contain it: their shells find every contact in its exact field. All others have both roles. The
/// contacts of a pair of two bodies without a shell (an attached map and a map or a half-space of the world) have no
/// force.
///
/// No pair is left out because it cannot be tested. A pair of two bodies with half-spaces stays, and is NOT_CHECKED;
/// Scene::warnings name it. So is a pair with a body that cannot be checked, which requires nothing to be built; but if
/// that body is a tile of a map (BodyDescription::map), which is still to come, the other body is prepared for it. An
/// allowed pair may name bodies that the scene does not have (an SRDF's links without collision geometry).
/// @throws std::invalid_argument if two bodies share a name, or an allowed pair names the same body twice.
ScenePlan planScene(const SceneDescription& description, const PlanOptions& options = {});

class RestingAnswers;

/// Bodies that are ready to be checked, and their pairs.
struct Scene {
  BodyList bodies;
  std::vector<PlannedPair> pairs;
  std::vector<PairDecision> left_out;
  std::vector<std::string> visual_only;  ///< as in SceneDescription: nothing is known of where they are solid
  std::vector<BodyReport> reports;
  std::vector<std::string> warnings;       ///< about its pairs, and those that several bodies share
  std::vector<std::string> overlap_notes;  ///< about pairs of links that overlap at rest
  ErrorSources bound;                      ///< of verdicts, largest over all pairs; chord: as the options allow
  ErrorSources contact_bound;  ///< the same for times and depths of contacts, which come from fields and shells
  double motion_margin = 0.0, motion_error = 0.0;  ///< as in BodyOptions [m]
  std::optional<double> max_error;                 ///< as requested [m]
  double build_seconds = 0.0;
  /// What is known of pairs that do not move relative to each other, shared by all monitors of the scene and its next
  /// versions. Null: each monitor finds it out itself, in every cycle.
  std::shared_ptr<RestingAnswers> resting;
};

/// The options that planScene() needs.
inline PlanOptions planOptions(const BodyOptions& options) {
  PlanOptions plan;
  plan.shell_spacing = options.shell.spacing;
  return plan;
}

/// Builds, or loads from the cache, what the plan needs; meshes of equal content once. A body whose field or shell
/// cannot be built keeps its index, with Body::failure set; other bodies are not affected.
/// @param progress  called with the body's name and the share of all bodies done.
/// @throws std::invalid_argument if options.max_error is larger than every body; std::length_error if field and shell
/// are shares of it, and one of them would be too large also at twice max_error; Cancelled.
Scene buildScene(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options,
                 const std::function<void(const std::string&, double)>& progress = {});

/// Removes pairs from a scene that is built; bodies stay unchanged.
/// @param pairs  of the scene, by index.
void leaveOut(const std::vector<PairDecision>& pairs, Scene& scene);

/// A scene of bodies that are already prepared, with all of their pairs except those of two world bodies. A pair of two
/// bodies with half-spaces cannot be tested: it is NOT_CHECKED, and Scene::warnings name it.
/// @param motion_margin  as in BodyOptions [m].
/// @throws std::invalid_argument if two bodies share a name, or one has neither field nor shell.
Scene makeScene(std::vector<Body> bodies, double motion_margin = 1e-3);

/// The plan as one table for the log: body, geometry, field, shell, cells, bytes, error bound by source, pairs; below
/// it failures, warnings, and what was left out, by reason.
std::string planTable(const Scene& scene);

/// An immutable version of the world: bodies, and the pairs to check. May be read from any thread for as long as it is
/// held.
struct WorldSnapshot {
  std::uint64_t version = 0;  ///< 1 for the first; increases by one
  std::shared_ptr<const SceneDescription> description;
  std::shared_ptr<const Scene> scene;
  std::vector<std::uint64_t> body_ids;  ///< per body: the same in all versions as long as a body of its name exists

  std::vector<std::string> warnings;  ///< about bodies made for this version, and pairs without a test
  int prepared = 0;                   ///< bodies whose field, shell or triangles were made for this version
  int shared = 0;                     ///< bodies that reuse one of the same geometry, with another pose or name
  double seconds = 0.0;               ///< time that making it took
};

/// Makes the next snapshot of a world from the last one. What has not changed is shared, so a change costs as much as
/// the changed bodies, plus the bookkeeping of pairs (some milliseconds for 10,000 of them).
///
/// Bodies are built once. They are kept by their content as long as they are in use; the last unused ones are kept,
/// too: an object that is moved, attached, or put back is not built again. The parts of a body only grow: a link whose
/// shell was needed once keeps it.
///
/// A monitor switches to a snapshot by Monitor::prepare() and Monitor::adopt(). Thread-safe: building, which may take
/// long, is prepare(), and holds up nobody; making a version of what is built is next(), one call at a time.
class WorldEditor {
 public:
  /// Without a world; see begin().
  /// @param options  of all bodies that it builds.
  explicit WorldEditor(const BodyOptions& options);
  ~WorldEditor();

  /// Begins with a scene that is already built, as version 1. Pairs that it leaves out stay left out in later versions.
  /// @param plan  the plan from which it was built, with the same options.
  std::shared_ptr<const WorldSnapshot> begin(SceneDescription description, const ScenePlan& plan, Scene scene);

  /// The bodies of a version that is to be made. They are kept by the versions that use them, not by the editor.
  struct Parts;

  /// Builds the bodies of a version, as far as the last one does not have them.
  /// @param progress  called with the name of each body that is being built.
  /// @throws std::invalid_argument if two bodies share a name, or a new or changed one cannot be built (the message
  /// names it); Cancelled.
  std::shared_ptr<const Parts> prepare(const SceneDescription& description,
                                       const std::function<void(const std::string&)>& progress = {}) const;

  /// Makes the next version from bodies that are ready. If it throws, the last version is unchanged.
  /// @return null, and the last version is unchanged, if one is not: `parts` were prepared for another description.
  /// @throws std::invalid_argument if two bodies share a name; Cancelled.
  std::shared_ptr<const WorldSnapshot> next(SceneDescription description, const Parts& parts);

  /// The same with the bodies of this description.
  /// @throws also what prepare() does.
  std::shared_ptr<const WorldSnapshot> next(const SceneDescription& description);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sdf_ccd
