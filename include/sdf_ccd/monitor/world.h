#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/scene/prepare_body.h"
#include "sdf_ccd/scene/scene.h"
#include "sdf_ccd/scene/scene_description.h"

namespace sdf_ccd {

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

  /// Takes a scene that is already built as version 1. Pairs that it leaves out stay left out in later versions.
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
