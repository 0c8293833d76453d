#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include <ros/time.h>

namespace sdf_ccd {

struct CheckedWorld;

/// When a live map was last received. Of every version of the world that holds this map, so whoever uses one, such as a
/// cycle, can test by itself whether the map is too old. Thread-safe, without waiting.
class MapAge {
 public:
  /// @param max_age  a map received longer ago is too old [s].
  MapAge(std::string topic, double max_age, const ros::Time& received);

  /// The same map has been received again.
  void set(const ros::Time& received);

  bool isTooOld(const ros::Time& now);

  /// Why a map that is too old is not used.
  const std::string& text() const { return text_; }

 private:
  const std::string text_;
  const double max_age_;
  std::atomic<std::int64_t> received_;  // [ns]
};

/// If the world's map is too old, sets why its tiles are not known, as if tf did not know their poses. If there are
/// none, since nothing was occupied: all bodies, until the world has a placeholder for the next map.
/// @param missing  per body of the world: why it is not known; empty if it is.
void addOutdatedMap(const CheckedWorld& world, const ros::Time& now, std::vector<std::string>& missing);

}  // namespace sdf_ccd
