#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pair_role.h"

namespace sdf_ccd {

/// Collects the contacts of a pair over all roles and parts: intervals, points, impulse.
///
/// Chords are processed in blocks and their results are joined at once, so that the memory is that of one shell's
/// points, however many chords the points are inside on.
///
/// Works in frame C: world axes at body A's origin at the span's end. Moments about a far world origin would lose the
/// precision that moments about the body keep.
class ContactCollector {
 public:
  /// @param pair     gives the bodies, the span of the motion, and the error of contacts.
  /// @param crosses  whether the surfaces are known to cross.
  void begin(const CycleMotion& motion, const PairResult& pair, bool crosses);

  /// Adds the contacts of one role; PairRole::cut() must have been called.
  /// @param weight  share of the role's impulse where the other role finds the same contact: roleWeight().
  void add(PairRole& role, double weight, const ContactOptions& options, bool with_impulse);

  /// Writes intervals, deepest point, points and wrenches to the result.
  void finish(const CycleRequest& request, PairResult& result);

 private:
  struct Found {
    int role;
    int point;
    ContactPoint contact;
    std::size_t part;            // of the body with the field
    const DistanceField* field;  // to be queried for the depth's error later; null if the error is known
    Vector3d p_F;                // position in that field
    double reach;                // HitDepth::reach
  };

  struct Peak {
    const Found* deepest = nullptr;
    double reach = 0.0;  // of all points of its interval
  };

  void setFieldPoses(const PairRole& role);
  const ChordPath& blockOf(const ChordPath& path, std::size_t first, std::size_t size);
  void addHits(const ContactInput& input, std::size_t part, bool shell_is_a);
  void addGroups(const ContactInput& input, std::size_t part, const GroupedShell& shell, bool shell_is_a, double weight,
                 const ContactOptions& options, bool with_impulse);
  bool haveSharedPoint();
  void join();
  void joinWhereMany();
  static bool isDeeper(const Found& a, const Found& b);
  void sortDeepest(std::size_t count);
  void allowForUnions();
  void addPeaks(PairResult& result);
  void setError(const Found& found, double reach, ContactPoint& point) const;
  void integrate(const ContactInput& input, const ContactOptions& options, bool with_impulse);
  bool bearsForce(const ContactInput& input, std::size_t hit) const;

  double tolerance() const;
  double duration() const { return motion_->times[span_.last] - motion_->times[span_.first]; }

  const CycleMotion* motion_ = nullptr;
  WaypointSpan span_;
  int body_a_ = -1, body_b_ = -1;
  std::array<const Body*, 2> solids_{};  // with the fields, by role
  Vector3d p_WC_ = Vector3d::Zero();
  Wrench impulse_on_a_C_;
  Intervals intervals_;
  std::vector<Found> found_;
  bool is_divided_ = false;              // a point may have a hit on each of several chords or in several parts
  std::vector<std::uint32_t> points_;    // of found_ that may have several hits: role and point
  std::vector<std::uint32_t> by_depth_;  // indices in found_: the records are too large to sort
  std::vector<Peak> peaks_;              // per interval
  std::vector<Isometry3d> X_CF_;         // per chord end: pose of the field's body
  std::vector<Isometry3d> X_CG_;         // the same for a part, in one block
  ChordPath block_;
  ShellQueryResult query_;
  PointGroups groups_;
  std::vector<ShellHit> listed_;                     // hits of a block
  std::vector<ShellHit> hits_;                       // the hits that are integrated together
  std::size_t most_found_ = 0, most_intervals_ = 0;  // sizes at which the results are joined
  ContactImpulse impulse_;
  bool crosses_ = false;
  double path_error_ = 0.0;      // [m]
  double position_error_ = 0.0;  // the largest of the shells [m]
  double deepest_ = 0.0;         // of the points found so far [m]
  double group_reach_ = 0.0;     // upper bound of the depth of points that were taken together [m]
  std::vector<ShellHit> bearing_hits_;
  ContactImpulse bearing_impulse_;
};

}  // namespace sdf_ccd
