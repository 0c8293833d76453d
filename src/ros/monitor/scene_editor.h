#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include <tbb/task_arena.h>

#include "ros/monitor/monitor_loop.h"
#include "ros/monitor/outputs.h"
#include "ros/monitor/queries.h"
#include "ros/world/changing_scene.h"
#include "sdf_ccd/UpdateScene.h"

namespace sdf_ccd {

/// What a version of the world needs to be checked, ready to be taken over between two cycles.
struct PreparedWorld {
  std::unique_ptr<LoopChange> loop;
  std::unique_ptr<Outputs::Change> outputs;
};

/// The field of a mesh, made elsewhere.
struct MadeField {
  std::shared_ptr<const TriangleMesh> mesh;
  DistanceField field;
};

/// Makes the next version of the world beside the cycles, by threads that call it, one after the other and of lower
/// priority than cycles, on at most half of the cores; and hands it to the thread that runs these.
///
/// A CancelScope of the calling thread ends a change with Cancelled; what is prepared until then is kept, the scene
/// stays as it was.
class SceneEditor {
 public:
  struct Parts {
    MonitorLoop& loop;
    Outputs& outputs;
    Queries& queries;
  };

  /// @param world   the first version, of which `editor` is the editor.
  /// @param wake    called when a version is ready: the cycles' thread is to call adopt() soon.
  /// @param changed  called by the thread that has changed it, when the cycles have taken a version over, or will.
  SceneEditor(std::unique_ptr<WorldEditor> editor, const DescribedScene& described, const MonitorParameters& parameters,
              const Parts& parts, std::function<void()> wake, std::function<void(const CheckedWorld&)> changed);
  ~SceneEditor();

  /// Answers a request. Never throws but for Cancelled.
  void update(const UpdateScene::Request& request, UpdateScene::Response& response);

  /// Puts a live map's tiles in the place of those before. @return the version with them.
  /// @throws std::exception if they cannot be had; Cancelled. The scene stays as it is then.
  /// @param fields  of those tiles that are new.
  std::uint64_t setMap(std::vector<BodyDescription> tiles, const std::vector<MadeField>& fields);

  /// The last version that was made. From any thread.
  std::shared_ptr<const CheckedWorld> world();

  /// For what is made beside cycles.
  tbb::task_arena& arena() { return arena_; }

  /// Takes over what is ready, if anything is; by the cycles' thread, between two cycles. Some microseconds.
  /// @return whether there was something.
  bool adopt();

 private:
  class Turn;
  void edit(const UpdateScene::Request& request, UpdateScene::Response& response);
  std::shared_ptr<const CheckedWorld> make(const ChangingScene& scene, std::string& making);
  bool handOver(const std::shared_ptr<const CheckedWorld>& world);
  bool goOnWith(ChangingScene scene, const std::shared_ptr<const CheckedWorld>& world);
  void setLast(std::shared_ptr<const CheckedWorld> world);
  void withdraw();
  void save(const std::string& file, const ChangingScene& scene, ChangeSources& sources);

  std::unique_ptr<WorldEditor> editor_;
  Parts parts_;
  RequestFiles files_;
  RequestLimits limits_;
  std::function<void()> wake_;
  std::function<void(const CheckedWorld&)> changed_;
  tbb::task_arena arena_;

  std::mutex last_mutex_;
  std::timed_mutex turn_;
  std::atomic<int> callers_{0};
  ChangingScene scene_;                                 // guarded by turn_, as all below
  std::shared_ptr<const CheckedWorld> last_;            // that was made; also by last_mutex_
  std::unique_ptr<PreparedWorld> given_;                // to the cycles' thread, last
  std::atomic<PreparedWorld*> offered_{nullptr};        // until that takes it
  std::atomic<const PreparedWorld*> adopted_{nullptr};  // when it has taken it over
};

}  // namespace sdf_ccd
