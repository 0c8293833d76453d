#pragma once

#include <algorithm>

namespace sdf_ccd {

/// Distance level of a scene, from two thresholds.
enum class Proximity { kNotWatched, kFree, kWarning, kStop };

struct ProximityThresholds {
  double warning = 0.0;     ///< closer than this is kWarning [m]; 0: no warning level
  double stop = 0.0;        ///< closer than this is kStop [m]; 0: no stop level
  double hysteresis = 0.0;  ///< a level is left only at its threshold plus this [m]

  bool any() const { return warning > 0.0 || stop > 0.0; }
};

/// Follows the level over cycles. It rises at once, and falls with hysteresis.
class ProximityWatch {
 public:
  /// @param to_warning, to_stop  how much farther the pairs are than their thresholds, the least of all pairs [m];
  /// infinite for a level that is not watched.
  Proximity update(double to_warning, double to_stop, double hysteresis) {
    const auto isWithin = [&](Proximity level, double margin) { return margin < (level_ >= level ? hysteresis : 0.0); };
    level_ = isWithin(Proximity::kStop, to_stop)         ? Proximity::kStop
             : isWithin(Proximity::kWarning, to_warning) ? Proximity::kWarning
                                                         : Proximity::kFree;
    return level_;
  }

 private:
  Proximity level_ = Proximity::kFree;
};

}  // namespace sdf_ccd
