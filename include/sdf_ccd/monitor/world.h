#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/body/body_options.h"
#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// What is checked at one time, never changed: bodies, and pairs of them. Whoever holds it may read it from any thread,
/// as long as he likes.
struct WorldSnapshot {
  std::uint64_t version = 0;  ///< increases by one from each to the next; the first is 1
  std::shared_ptr<const SceneDescription> description;
  std::shared_ptr<const Scene> scene;
  std::vector<std::uint64_t> body_ids;  ///< per body: the same in all versions as long as it is there under its name

  int prepared = 0;      ///< bodies whose field, shell or triangles were made for this version
  int shared = 0;        ///< bodies that are another one with the same geometry, in another place or under another name
  double seconds = 0.0;  ///< that making it took
};

/// Makes the next snapshot of a world from the last one: what has not changed is shared, so that a change costs what it
/// changes, and the pairs' bookkeeping (some milliseconds for 10,000 of them).
///
/// Bodies are made once, and kept by their content for as long as they are in use, and the last of those out of use
/// too: an object that is moved, attached, or put back is not made again. What a body is made with only grows: a link
/// whose shell was needed once keeps it.
///
/// A monitor takes over a snapshot by Monitor::prepare() and Monitor::adopt(). One thread at a time.
class WorldEditor {
 public:
  explicit WorldEditor(const BodyOptions& options);
  ~WorldEditor();

  /// Takes a scene that is built already as version 1. Pairs that it leaves out are left out of later ones, too.
  /// @param plan  that it was built by, with the same options.
  std::shared_ptr<const WorldSnapshot> begin(SceneDescription description, const ScenePlan& plan, Scene scene);

  /// Takes the field of a mesh that is made already (a tile of a map), for descriptions that have that mesh, as long as
  /// the mesh lives. It must be as accurate as the options ask for.
  void provide(const std::shared_ptr<const TriangleMesh>& mesh, const DistanceField& field);

  /// Makes the next version. If it throws, the last version stays the last.
  /// @param progress  called with the name of each body that is being made.
  /// @throws std::invalid_argument if two bodies share a name, or one that is new or has changed cannot be made (the
  /// message names it); std::length_error if it is expected to take more than options allow; Cancelled.
  std::shared_ptr<const WorldSnapshot> next(SceneDescription description,
                                            const std::function<void(const std::string&)>& progress = {});

  /// The last version; null before the first.
  const std::shared_ptr<const WorldSnapshot>& last() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sdf_ccd
