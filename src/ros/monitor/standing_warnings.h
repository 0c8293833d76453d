#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace sdf_ccd {

/// Conditions that last, and that whoever reads a verdict must know, as it then says less than it seems to: objects of
/// the world that move with the robot, pairs that are set aside. They are in every MonitorState, in rviz's status and
/// in the diagnostics. Any thread may use it.
class StandingWarnings {
 public:
  /// Sets the warning of its kind; an empty text removes it.
  /// @param kind  which condition it is about; the warnings are listed in the order of their kinds.
  void set(const std::string& kind, const std::string& text);

  /// All warnings. Reuses the memory of what it overwrites.
  void copyTo(std::vector<std::string>& texts) const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::string> texts_;  // by kind
};

}  // namespace sdf_ccd
