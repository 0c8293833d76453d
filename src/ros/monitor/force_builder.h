#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "ros/monitor/scene_editor.h"
#include "ros/monitor/work_arena.h"
#include "ros/tf/tf_history.h"

namespace sdf_ccd {

/// Marks the bodies with meshes, except for maps: their fields and shells take most of the time that a monitor needs to
/// start, and no verdict needs them.
void setForces(Forces forces, std::vector<BodyDescription>& bodies);

/// Builds the fields and shells of the bodies that await them (Forces::kAwaited), in a thread of its own beside the
/// cycles: those of the nearest pairs first, a few at a time. A body for which this fails keeps its verdicts.
class ForceBuilder {
 public:
  /// @param is_wanted  asked until it is: whether anybody reads forces. Called from the thread.
  ForceBuilder(SceneEditor& editor, const TfHistory& history, std::function<bool()> is_wanted);
  ~ForceBuilder();

 private:
  void run();
  void buildAll();
  std::vector<std::string> nearest(std::size_t pairs) const;

  SceneEditor& editor_;
  const TfHistory& history_;
  const std::function<bool()> is_wanted_;
  WorkArena arena_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace sdf_ccd
