#pragma once

namespace sdf_ccd {

/// How near anything is, by two thresholds.
enum class Proximity { kNotWatched, kFree, kWarning, kStop };

struct ProximityThresholds {
  double warning = 0.0;     ///< nearer than this is kWarning [m]; 0: there is no such level
  double stop = 0.0;        ///< nearer than this is kStop [m]; 0: there is no such level
  double hysteresis = 0.0;  ///< a level is left only this much beyond its threshold [m]

  bool any() const { return warning > 0.0 || stop > 0.0; }

  /// Pairs that surely are farther apart than this change nothing [m].
  double range() const { return any() ? (warning > stop ? warning : stop) + hysteresis : 0.0; }
};

/// Follows the level over cycles. It rises at once, and falls behind the hysteresis.
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
