#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "contact_collector.h"
#include "contact_refinement.h"
#include "pair_role.h"
#include "surface_pair.h"

namespace sdf_ccd {

/// What checking a pair needs meanwhile. It is used again for the next one, so that a cycle like the last allocates
/// nothing, and memory does not grow with the number of pairs.
struct PairMemory {
  std::array<RoleMemory, 4> roles;
  ContactCollector collector;
  std::vector<RelativeMotionBounds> bounds;  ///< of the surfaces' motion
  SeparationMemory separation;
  ContactRefinement::Memory refinement;
};

/// As new, but with its memory and its span.
void clear(PairResult& result);

/// Checks one pair, cycle after cycle, and knows between them how far apart it was.
class PairChecker {
 public:
  PairChecker(const Scene& scene, const PlannedPair& pair, const std::vector<ContactCollector::Siblings>& siblings,
              const MonitorOptions& options);

  /// Checks the pair over `result.span`, and keeps what it knows if that is empty. Never throws for a motion that
  /// cannot be followed: the pair is NOT_CHECKED then.
  /// @param bodies  have taken the motion.
  /// @param memory  this call's alone.
  void run(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request, PairMemory& memory,
           PairResult& result);

  /// Leaves the pair untested, over a span that is not empty: it is UNCERTAIN, or CLEAR if the bodies' balls do not meet.
  /// @param clearance  lower bound of the distance of the bodies all over the span, below zero how far they may overlap
  /// at most [m]; −∞ if nothing is known.
  /// @param memory  this call's alone.
  void postpone(const CycleMotion& motion, const SweptBodies& bodies, double clearance, PairMemory& memory,
                PairResult& result);

  /// Forgets how far apart the bodies were, and all else of earlier cycles.
  void forget() {
    forgetClearance();
    if (surfaces_) surfaces_->forget();
  }

  /// What is known since the last cycle, where others kept it.
  /// @param clearance  lower bound of the distance [m], of bodies at these poses.
  void remember(double clearance, const Isometry3d& X_WA, const Isometry3d& X_WB);

  /// Takes over what another checker knows of the same pair, in a scene that has its bodies too.
  void take(const PairChecker& other);

  /// Whether the pair is known to be clear, and by how much at the last run's end [m].
  bool isKnown() const { return clearance_ != kUnknown; }
  double clearance() const { return clearance_; }

  /// Error of its verdicts where it is clear, but for the motion's.
  ErrorBound bound() const { return surfaces_ ? ErrorBound{0.0, 0.0, 0.0, surfaces_->deviation()} : bound_; }

  /// Farther than this, but for the motion's error, a test could not find anything: what it finds is off by field and
  /// chord error at most [m]. What triangles are off by, their clearance has lost already.
  double margin() const { return surfaces_ ? 0.0 : bound_.total() + bound_.field + 2.0 * options_.chords.tolerance; }

 private:
  static constexpr double kUnknown = -std::numeric_limits<double>::infinity();

  void forgetClearance() {
    clearance_ = kUnknown;
    outside_ = false;
  }
  bool canBeChecked(const CycleMotion& motion, const SweptBodies& bodies, PairResult& result);
  void check(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request, PairResult& result);
  const RelativeMotion& relativeMotion() const { return surfaces_ ? surfaces_->motion() : roles_.front().motion(); }
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span);
  void setRoles(const SweptBodies& bodies, const WaypointSpan& span);
  double givenError(const CycleMotion& motion) const;
  void setError(const ErrorBound& bound, double root, PairResult& result) const;
  void setClear(double clearance, PairResult& result);
  void setCrossing(const ContactPoint& crossing, PairResult& result);
  void doubt(PairResult& result);
  bool isCertain(const PairResult& result) const;
  bool clearBySurfaces(SurfacePair::Answer& answer, PairResult& result);
  void setSurfaceError(bool is_near, const ErrorBound& error, PairResult& result) const;
  bool clearFromAfar(double margin, PairResult& result);
  double ballClearance(const SweptBodies& bodies, const WaypointSpan& span) const;
  void cutRoles(PairResult& result);
  std::optional<ContactPoint> crossingAtATime(const CycleMotion& motion, const WaypointSpan& span) const;
  void findContacts(const CycleMotion& motion, const CycleRequest& request, const std::optional<ContactPoint>& known,
                    PairResult& result);

  const Scene& scene_;
  const PlannedPair& pair_;
  const std::vector<ContactCollector::Siblings>& siblings_;  // per body
  const MonitorOptions& options_;
  std::vector<PairRole> roles_;                  // one to four
  bool balls_hold_;                              // the bodies' balls hold all of them
  bool open_;                                    // a place inside some field may be none inside its body
  std::optional<SurfacePair> surfaces_;          // if both bodies are all triangles
  std::optional<ContactRefinement> refinement_;  // if depths can be measured on these
  bool outside_ = false;                         // neither had a part wholly inside the other at the last cycle's end
  ErrorBound bound_;                             // of field and gap
  double clearance_ = kUnknown;                  // lower bound of the surfaces' distance at the last cycle's end [m]
  Isometry3d X_FP_last_;  // of the surfaces or the first role, at the last cycle's end; valid if the clearance is known
  double travel_ = 0.0;   // no point of either body goes farther against the other in this cycle [m]
  double motion_error_ = 0.0;     // of the modelled motion, and of computing with its poses [m]
  PairMemory* memory_ = nullptr;  // during a check
};

}  // namespace sdf_ccd
