#pragma once

namespace sdf_ccd {

/// Distance level of a scene, from two thresholds.
enum class Proximity { kNotWatched, kFree, kWarning, kStop };

struct ProximityThresholds {
  double warning = 0.0;     ///< closer than this is kWarning [m]; 0: no warning level
  double stop = 0.0;        ///< closer than this is kStop [m]; 0: no stop level
  double hysteresis = 0.0;  ///< a level is left only at its threshold plus this [m]

  bool any() const { return warning > 0.0 || stop > 0.0; }

  /// Pairs that are certainly farther apart than this cannot change the level [m].
  double range() const { return any() ? (warning > stop ? warning : stop) + hysteresis : 0.0; }
};

/// Follows the level over cycles. It rises at once, and falls with hysteresis.
class ProximityWatch {
 public:
  /// @param distance  lower bound of all distances [m]; 0 where bodies touch, may touch, or are not checked.
  Proximity update(double distance, const ProximityThresholds& thresholds) {
    const auto isWithin = [&](Proximity level, double threshold) {
      return threshold > 0.0 && distance < threshold + (level_ >= level ? thresholds.hysteresis : 0.0);
    };
    level_ = !thresholds.any()                                   ? Proximity::kNotWatched
             : isWithin(Proximity::kStop, thresholds.stop)       ? Proximity::kStop
             : isWithin(Proximity::kWarning, thresholds.warning) ? Proximity::kWarning
                                                                 : Proximity::kFree;
    return level_;
  }

 private:
  Proximity level_ = Proximity::kNotWatched;
};

}  // namespace sdf_ccd
