#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// When a live map was last received. Of every version of the world that holds this map, so whoever uses one, such as a
/// cycle, can test by itself whether the map is too old. Thread-safe, without waiting.
class MapAge {
 public:
  using Time = std::chrono::nanoseconds;  ///< since the epoch

  /// @param max_age  a map received longer ago is too old [s].
  MapAge(std::string topic, double max_age, Time received);

  /// The same map has been received again.
  void set(Time received) { received_ = received; }

  bool isTooOld(Time now);

  /// Why a map that is too old is not used.
  const std::string& text() const { return text_; }

 private:
  const std::string text_;
  const double max_age_;
  std::atomic<Time> received_;
};

/// If the map is too old, sets why its tiles are not known, as if their poses were not. If there are none, since
/// nothing was occupied: all bodies, until the world has a placeholder for the next map.
/// @param age      of the map; null if it never gets too old.
/// @param missing  per body: why it is not known; empty if it is.
void addOutdatedMap(MapAge* age, MapAge::Time now, const BodyList& bodies, std::vector<std::string>& missing);

}  // namespace sdf_ccd
