#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "ros/monitor/queries.h"
#include "ros/monitor/work_arena.h"
#include "ros/monitor/work_turns.h"
#include "ros/monitor/world_handover.h"
#include "ros/world/apply_change.h"
#include "sdf_ccd/UpdateScene.h"

namespace sdf_ccd {

/// Makes the next version of the world in the calling threads, in parallel to the cycles and with lower priority; then
/// hands it over to the thread of the cycles.
///
/// What may take long is done before anybody waits for it: requests read their files and build their bodies one after
/// the other, while maps, which have threads of their own, come and go. Only the bookkeeping of a version, which each
/// map needs as well, is done by one at a time, on top of what the others have changed meanwhile; maps go first.
///
/// A CancelScope of the calling thread ends a change with Cancelled; the scene does not change then.
class SceneEditor {
 public:
  struct Parts {
    MonitorLoop& loop;
    Outputs& outputs;
    Queries& queries;
  };

  /// @param editor  of the first version of the world, which `parts` use.
  /// @param wake    called when a version is ready: the thread of the cycles should call adopt().
  /// @param changed  called by the changing thread when the cycles have adopted a version, or will adopt it.
  SceneEditor(std::unique_ptr<WorldEditor> editor, const DescribedScene& described, const MonitorParameters& parameters,
              const Parts& parts, std::function<void()> wake, std::function<void(const CheckedWorld&)> changed);
  ~SceneEditor();

  /// Answers a request, within the parameter request_time. Throws only Cancelled.
  void update(const UpdateScene::Request& request, UpdateScene::Response& response);

  /// Replaces the tiles of the live map. Waits for no request, but for the bookkeeping of one that is under way.
  /// @param objects  as which some of them are judged.
  /// @param age    of the map; null if it never gets too old.
  /// @param arena  of the calling thread.
  /// @return the version with the new ones.
  /// @throws std::exception if they cannot be made; Cancelled. The scene does not change then.
  std::uint64_t setMap(std::vector<BodyDescription> tiles, TileObjects objects, std::shared_ptr<MapAge> age,
                       WorkArena& arena);

  /// Builds fields and shells of bodies that await them, and makes a version with these; others change the scene
  /// meanwhile. Where that fails, a body has Forces::kFailed from then on, which is logged.
  /// @param arena  of the calling thread.
  /// @throws std::exception if no version can be made; Cancelled. The scene does not change then.
  void addForces(const std::vector<std::string>& bodies, WorkArena& arena);

  /// The last version that was made. May be called from any thread.
  std::shared_ptr<const CheckedWorld> world();

  /// Adopts a version if one is ready. To be called by the thread of the cycles, between two cycles; takes
  /// microseconds.
  /// @return whether there was one.
  bool adopt() { return handover_.adopt(); }

 private:
  class Turn;
  enum class Changer { kRequest, kMap, kForces };
  struct Draft;

  void edit(const UpdateScene::Request& request, UpdateScene::Response& response, std::string& making);
  void build(Draft& draft);
  void commit(Draft& draft);
  bool makeNext(Draft& draft);
  std::unique_ptr<PreparedWorld> prepare(const std::shared_ptr<const CheckedWorld>& world, WorkArena& arena);
  std::shared_ptr<const ChangingScene> scene();
  void save(const std::string& file, const ChangingScene& scene, ChangeSources& sources);

  std::unique_ptr<WorldEditor> editor_;
  Parts parts_;
  RequestFiles files_;
  RequestLimits limits_;
  const double request_time_;  // [s]
  std::function<void()> wake_;
  std::function<void(const CheckedWorld&)> changed_;
  WorldHandover handover_;

  WorkTurns requests_;
  WorkArena arena_;  // of requests

  std::mutex turn_mutex_;
  std::condition_variable turn_changed_;
  bool is_busy_ = false;  // guarded by turn_mutex_, as maps_waiting_: somebody makes the next version
  int maps_waiting_ = 0;

  std::mutex last_mutex_;
  std::shared_ptr<const ChangingScene> scene_;  // guarded by last_mutex_, as last_; changed by who has the turn
  std::shared_ptr<const CheckedWorld> last_;    // last version made
};

}  // namespace sdf_ccd
