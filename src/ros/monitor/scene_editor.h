#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "ros/monitor/monitor_loop.h"
#include "ros/monitor/outputs.h"
#include "ros/monitor/queries.h"
#include "ros/monitor/work_arena.h"
#include "ros/world/changing_scene.h"
#include "sdf_ccd/UpdateScene.h"

namespace sdf_ccd {

/// The parts for a version of the world, ready to be adopted between two cycles.
struct PreparedWorld {
  std::unique_ptr<LoopChange> loop;
  std::unique_ptr<Outputs::Change> outputs;
};

/// Makes the next version of the world in the calling threads, one after the other, in parallel to the cycles and with
/// lower priority, on at most half of the cores; then hands it over to the thread of the cycles.
///
/// A CancelScope of the calling thread ends a change with Cancelled; what was prepared until then is kept, and the
/// scene does not change.
class SceneEditor {
 public:
  struct Parts {
    MonitorLoop& loop;
    Outputs& outputs;
    Queries& queries;
  };

  /// @param editor  of the first version of the world, which `parts` use.
  /// @param wake    called when a version is ready: the thread of the cycles should call adopt() soon.
  /// @param changed  called by the changing thread when the cycles have adopted a version, or will adopt it.
  SceneEditor(std::unique_ptr<WorldEditor> editor, const DescribedScene& described, const MonitorParameters& parameters,
              const Parts& parts, std::function<void()> wake, std::function<void(const CheckedWorld&)> changed);
  ~SceneEditor();

  /// Answers a request. Throws only Cancelled.
  void update(const UpdateScene::Request& request, UpdateScene::Response& response);

  /// Replaces the tiles of the live map. @return the version with the new ones.
  /// @throws std::exception if they cannot be made; Cancelled. The scene does not change then.
  std::uint64_t setMap(std::vector<BodyDescription> tiles);

  /// The last version that was made. May be called from any thread.
  std::shared_ptr<const CheckedWorld> world();

  /// For other work in parallel to the cycles.
  WorkArena& arena() { return arena_; }

  /// Adopts a version if one is ready. To be called by the thread of the cycles, between two cycles; takes
  /// microseconds.
  /// @return whether there was one.
  bool adopt();

 private:
  class EditLock;
  void edit(const UpdateScene::Request& request, UpdateScene::Response& response);
  std::shared_ptr<const CheckedWorld> make(const ChangingScene& scene, std::string& making);
  std::unique_ptr<PreparedWorld> prepare(const std::shared_ptr<const CheckedWorld>& world);
  bool handOver(std::unique_ptr<PreparedWorld> prepared);
  bool commit(ChangingScene scene, const std::shared_ptr<const CheckedWorld>& world,
              std::unique_ptr<PreparedWorld> prepared);
  void setLast(std::shared_ptr<const CheckedWorld> world);
  void withdraw();
  void save(const std::string& file, const ChangingScene& scene, ChangeSources& sources);

  std::unique_ptr<WorldEditor> editor_;
  Parts parts_;
  RequestFiles files_;
  RequestLimits limits_;
  std::function<void()> wake_;
  std::function<void(const CheckedWorld&)> changed_;
  WorkArena arena_;

  std::mutex last_mutex_;
  std::timed_mutex edit_mutex_;
  std::atomic<int> callers_{0};
  ChangingScene scene_;                                 // guarded by edit_mutex_, as all below
  std::shared_ptr<const CheckedWorld> last_;            // last version made; also guarded by last_mutex_
  std::unique_ptr<PreparedWorld> handed_over_;          // last version handed over to the cycles
  std::atomic<PreparedWorld*> pending_{nullptr};        // the same; null once the thread of the cycles has taken it
  std::atomic<const PreparedWorld*> adopted_{nullptr};  // the same, once the cycles use it
};

}  // namespace sdf_ccd
