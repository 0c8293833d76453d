#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "surface_pair.h"

namespace sdf_ccd {

/// Decides a pair cycle after cycle by the surfaces of its bodies, and keeps in between what it knows: a bound of their
/// distance, and whether one body is inside the other.
class PairVerdict {
 public:
  /// The bodies must outlive this. @param resolution  see SurfacePair.
  PairVerdict(const Body& a, const Body& b, double resolution);

  /// Whether there are surfaces that decide the pair. If not, only forget() and deviation() may be called.
  bool isPossible() const { return surfaces_.has_value(); }

  SurfacePair& surfaces() { return *surfaces_; }

  /// Error of the pair's verdict while it is clear, without the motion's error [m].
  double deviation() const { return surfaces_ ? surfaces_->deviation() : 0.0; }

  /// Sets the motion, and subtracts from the clearance what it may have used up.
  /// @param bounds  see RelativeMotion::set().
  void setMotion(const PairMotion& pair, std::vector<RelativeMotionBounds>& bounds);

  struct Answer {
    Verdict verdict;                       ///< CLEAR, with clearance(); CONTACT; UNCERTAIN
    std::optional<ContactPoint> crossing;  ///< if CONTACT: of the surfaces, or a point of one body inside the other
    double open_within;                    ///< if UNCERTAIN: see SurfacePair::Answer
  };

  /// Decides over the motion. @param motion_error  see SurfacePair::decide().
  Answer decide(double motion_error, SeparationMemory& memory);

  /// Lower bound of the distance at the end of the last motion of a pair that is known to be clear [m]; −∞ if it is
  /// not.
  double clearance() const { return clearance_; }
  bool isKnown() const { return clearance_ != kUnknown; }

  /// Sets the clearance at the motion's end, as found elsewhere.
  void setClear(double clearance) { clearance_ = clearance; }
  void forgetClearance();

  /// Sets the clearance of a pair that is not decided over a motion; if negative, its amount bounds the overlap [m].
  void postpone(double clearance);

  /// Hands the clearance over to the caller, who keeps it until he calls remember(); it is not known here meanwhile.
  double moveClearanceOut();

  /// Sets the clearance at the poses at which the caller has kept it.
  void remember(double clearance, const Isometry3d& X_WA, const Isometry3d& X_WB);

  /// The same for bodies whose balls are apart there.
  void setFar(double clearance, const Isometry3d& X_WA, const Isometry3d& X_WB);

  /// Discards all that is known.
  void forget();

  /// Whether a body is known to be inside the other one, from motions during which their surfaces stayed apart.
  bool isInside() const { return inside_.has_value(); }

 private:
  static constexpr double kUnknown = -std::numeric_limits<double>::infinity();

  /// Where it was last not known whether one body is inside the other, and how often in a row.
  struct Undecided {
    Isometry3d X_FP;
    int attempts;
  };

  void findContainment();

  std::optional<SurfacePair> surfaces_;
  bool outside_ = false;                      // neither body has a component wholly inside the other
  std::optional<InsidePoint> inside_;         // the surfaces are apart
  double clearance_ = kUnknown;               // [m]
  Isometry3d X_FP_ = Isometry3d::Identity();  // valid if one of these is known
  std::optional<Undecided> undecided_;
};

}  // namespace sdf_ccd
