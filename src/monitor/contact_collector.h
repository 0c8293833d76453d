#pragma once

#include <vector>

#include "pair_role.h"
#include "sdf_ccd/contact/penalty.h"

namespace sdf_ccd {

/// Collects the contacts of a pair over both roles and all parts: intervals, points, impulse.
///
/// Chords are taken in blocks, and what they find is put together as it comes, so that memory is as that of the points
/// of one shell, however many chords they are inside on.
///
/// Works in frame C: the world's axes about body A's origin at the span's end. Far from the world's origin, moments
/// about that would lose what the lever about the bodies still has.
class ContactCollector {
 public:
  using Siblings = std::vector<std::vector<SiblingField>>;  // per part of a body

  /// @param pair     whose bodies and span of the motion it is about; its error is known.
  /// @param crosses  whether it is known that the surfaces cross.
  void begin(const CycleMotion& motion, const PairResult& pair, bool crosses);

  /// Adds the contacts of one role; its path must be cut.
  /// @param shell_is_a  the shell's body is the pair's body A.
  /// @param weight      ½ where the other role sees the same contact too (design §3.7).
  void add(PairRole& role, bool shell_is_a, double weight, const Siblings& siblings, const ContactOptions& options,
           bool with_impulse);

  /// Whether it is known, from begin() or since, that the bodies' surfaces cross.
  bool crosses() const { return crosses_; }

  /// So deep is some point surely in a field without openings, but for the path's error [m]; 0 if none is.
  double certainDepth() const { return certain_depth_; }

  /// Writes intervals, deepest point, points and wrenches.
  void finish(const CycleRequest& request, PairResult& result);

 private:
  struct Found {
    int role;
    int point;
    ContactPoint contact;
    const DistanceField* field;  // that is still to be asked for the depth's error; null if it is known
    Vector3d p_F;                // where
  };

  void setFieldPoses(const PairRole& role);
  const ChordPath& blockOf(const ChordPath& path, std::size_t first, std::size_t size);
  bool passesThrough(const DistanceField& field, const PairRole& role, const ChordPath& path, std::size_t first,
                     std::size_t most) const;
  void addHits(const ContactInput& input, bool shell_is_a);
  void join();
  void joinWhereMany();
  void integrate(const ContactInput& input, const ContactOptions& options, bool with_impulse);
  bool needsErrors(const DistanceField& field) const;
  bool bearsForce(const ContactInput& input, std::size_t hit) const;

  double tolerance() const;
  double duration() const { return motion_->times[span_.last] - motion_->times[span_.first]; }

  const CycleMotion* motion_ = nullptr;
  WaypointSpan span_;
  int body_a_ = -1, body_b_ = -1;
  Vector3d p_WC_ = Vector3d::Zero();
  Wrench impulse_on_a_C_;
  Intervals intervals_;
  std::vector<Found> found_;
  std::vector<Isometry3d> X_CF_;  // per end of a chord, of the field's body
  std::vector<Isometry3d> X_CG_;  // the same of a part and a block
  ChordPath block_;
  ShellQueryResult query_;
  std::vector<ShellHit> listed_;                     // of a block
  std::vector<ShellHit> hits_;                       // some of them
  std::size_t most_found_ = 0, most_intervals_ = 0;  // before they are put together
  ContactImpulse impulse_;
  bool crosses_ = false;
  double path_error_ = 0.0;   // [m]
  bool is_doubtful_ = false;  // what is inside the role's field's body
  double certain_depth_ = 0.0;
  std::vector<ShellHit> bearing_hits_;
  ContactImpulse bearing_impulse_;
};

}  // namespace sdf_ccd
