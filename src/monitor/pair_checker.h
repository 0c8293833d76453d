#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "contact_refinement.h"
#include "pair_roles.h"
#include "resting_answers.h"
#include "sdf_ccd/cancel.h"
#include "surface_contacts.h"
#include "surface_pair.h"

namespace sdf_ccd {

/// Scratch memory for checking a pair. It is reused for the next pair, so that a cycle like the last one allocates
/// nothing and the memory does not grow with the number of pairs.
struct PairMemory {
  PairRoles::Memory roles;
  ContactCollector collector;
  std::vector<RelativeMotionBounds> bounds;  ///< of the motion of SurfacePair
  SeparationMemory separation;
  ContactRefinement::Memory refinement;
  CancelRequest::Clock::time_point deadline = CancelRequest::Clock::time_point::max();  ///< of all that is tested
};

/// What is known of a pair at the end of the last cycle.
struct PairState {
  static constexpr double kUnknown = -std::numeric_limits<double>::infinity();

  /// Where it was last not known whether one body is inside the other, and how often in a row.
  struct Undecided {
    Isometry3d X_FP;
    int attempts;
  };

  bool outside = false;                            ///< neither body has a component wholly inside the other
  std::optional<SurfacePair::InsidePoint> inside;  ///< the surfaces are apart
  double clearance = kUnknown;                     ///< lower bound of their distance [m]
  Isometry3d X_FP = Isometry3d::Identity();        ///< valid if one of these is known
  std::optional<Undecided> undecided;
  std::optional<Isometry3d> X_AB_as_it_came;  ///< there the answer depends on the motion before
};

/// Checks one pair, cycle after cycle, and stores a bound of its distance in between.
class PairChecker {
 public:
  PairChecker(const Scene& scene, const PlannedPair& pair, const std::vector<ContactCollector::BodyData>& body_data,
              const MonitorOptions& options);

  /// Checks the pair over `result.span`; if that is empty, what is stored stays. Does not throw if a body's poses
  /// cannot be followed: the pair is then NOT_CHECKED.
  /// @param bodies  must have the motion.
  /// If surfaces are known to cross, and contacts are wanted, the result is incomplete: complete() is to follow.
  /// @param memory  used by this call alone.
  /// @throws Cancelled if there is no verdict before PairMemory::deadline. A contact that is proved by then is one, but
  /// PairResult::incomplete.
  void run(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request, PairMemory& memory,
           PairResult& result);

  /// Computes what is missing in an incomplete result of run() with the same arguments. Where PairMemory::deadline
  /// comes first, it stays incomplete.
  void complete(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request, PairMemory& memory,
                PairResult& result);

  /// Whether complete() is to follow run().
  bool isToComplete() const { return is_to_complete_; }

  /// Leaves the pair untested, over a span that is not empty: UNCERTAIN, or CLEAR if the bodies' balls stay apart.
  /// @param clearance  lower bound of the bodies' distance over the whole span [m]; if negative, its amount bounds
  /// their overlap; −∞ if nothing is known.
  /// @param margin  as CycleRequest::margin.
  /// @param memory  used by this call alone.
  void postpone(const CycleMotion& motion, const SweptBodies& bodies, double clearance, double margin,
                PairMemory& memory, PairResult& result);

  /// Measures the distance of a pair that is known to be clear over the whole span. What is stored stays.
  /// @return a lower bound at the span's end [m]; empty if none is found.
  std::optional<double> measure(const CycleMotion& motion, const SweptBodies& bodies, const WaypointSpan& span,
                                PairMemory& memory);

  /// Discards the clearance and all other data of earlier cycles.
  void forget() {
    state_ = {};
    if (surfaces_) surfaces_->forget();
  }

  /// Sets the clearance at the end of the last cycle, if the caller has kept it.
  /// @param clearance  lower bound of the distance [m] of the bodies at these poses.
  void remember(double clearance, const Isometry3d& X_WA, const Isometry3d& X_WB);

  /// Takes over the stored data of another checker of the same pair, in a scene that has the same bodies.
  void take(const PairChecker& other) {
    state_ = other.state_;
    if (surfaces_) surfaces_->take(*other.surfaces_);
  }

  /// Whether the pair is known to be clear; clearance() then bounds its distance at the last run's end from below [m].
  bool isKnown() const { return state_.clearance != PairState::kUnknown; }
  double clearance() const { return state_.clearance; }

  /// Error bound of the pair's verdict while it is clear, without the motion's error.
  ErrorSources bound() const { return {0.0, 0.0, 0.0, surfaces_ ? surfaces_->deviation() : 0.0}; }

 private:
  void takeOff(double margin, PairResult& result) const;
  void forgetClearance() {
    state_.clearance = PairState::kUnknown;
    state_.outside = false;
  }
  bool canBeChecked(const CycleMotion& motion, const SweptBodies& bodies, PairResult& result);
  void check(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request, PairResult& result);
  void test(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request, double given_error,
            PairResult& result);
  // Of a pair whose bodies rest relative to each other:
  Isometry3d poseAtRest() const;
  RestingAnswers::Bodies restingBodies() const;
  bool isAnswered(const SweptBodies& bodies, double error, const CycleRequest& request, PairResult& result);
  void answerOnce(const SweptBodies& bodies, double error, const CycleRequest& request, PairResult& result);
  std::shared_ptr<const RestingAnswer> findAtRest(const Isometry3d& X_AB, double error,
                                                  const CycleRequest& request) const;

  const RelativeMotion& relativeMotion() const { return surfaces_->motion(); }
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span);
  double givenError(const CycleMotion& motion) const;
  void setClear(double clearance, PairResult& result);
  SurfaceContacts surfaceContacts(PairResult& result);
  void setCrossing(const ContactPoint& crossing, PairResult& result);
  void setIncomplete(const ContactPoint& proof, const CycleMotion& motion, const CycleRequest& request,
                     PairResult& result);
  double greatestDepthOfContact() const;
  void findContainment();
  bool isClear(SurfacePair::Answer& answer, PairResult& result);
  void setOpen(double open_within, PairResult& result) const;
  double ballClearance(const SweptBodies& bodies, const WaypointSpan& span) const;
  void describe(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request, double given_error,
                const std::optional<ContactPoint>& crossing, PairResult& result);
  void findContacts(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                    double given_error, const std::optional<ContactPoint>& crossing, PairResult& result);

  const Scene& scene_;
  const PlannedPair& pair_;
  const std::vector<ContactCollector::BodyData>& body_data_;  // per body
  const MonitorOptions& options_;
  RestingAnswers* resting_;    // null: every cycle is tested
  bool balls_contain_bodies_;  // the bodies' balls contain all of them
  PairRoles roles_;
  std::optional<SurfacePair> surfaces_;          // none: the pair cannot be checked
  std::optional<ContactRefinement> refinement_;  // if depths can be measured on the triangles
  std::string why_no_force_;                     // empty if there are forces
  ErrorSources contact_bound_;                   // of field and gap

  PairState state_;

  // Of this cycle:
  double travel_ = 0.0;  // upper bound of the relative displacement of the bodies' points in this cycle [m]
  /// Of the given motion, and of computing with its poses; during a check plus CycleRequest::margin, which counts like
  /// an error there [m].
  double motion_error_ = 0.0;
  bool is_to_complete_ = false;   // complete() is to follow
  PairMemory* memory_ = nullptr;  // during a call
};

}  // namespace sdf_ccd
