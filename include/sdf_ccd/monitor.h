#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/body.h"
#include "sdf_ccd/contact.h"
#include "sdf_ccd/motion.h"
#include "sdf_ccd/result.h"
#include "sdf_ccd/scene.h"
#include "sdf_ccd/segments.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Beyond it, rounding of the sum of margin and error bound would count [m].
constexpr double kLargestMargin = 1000.0;

class PairTimes;

/// The outputs wanted from a cycle; others are not computed.
struct CycleRequest {
  bool wrenches = true;
  int max_points = 0;  ///< contact points listed per pair, the deepest first

  /// Whether `clearance` and `error` of skipped pairs are those of this cycle. If not, `clearance` is a bound that
  /// holds as long as the pair is skipped, and `error` is that of the cycle in which skipping began: such a cycle
  /// touches only the pairs that it tests.
  bool skipped_pairs = true;

  /// Whether to compute intervals and deepest points; wrenches and points imply it. If not, a pair whose surfaces are
  /// found to cross, or of which one body is found inside the other, gets one interval and deepest point, where that
  /// was found and without a depth; no field is queried.
  bool contacts = true;

  /// Once this much of the cycle's time is used up [s], nothing more is tested; 0: no limit. Searches and integrals end
  /// within a millisecond. Verdicts come first: pairs without one are PairResult::postponed, and contacts that are
  /// known but not yet computed are PairResult::incomplete. Both come first in the next cycle. A pair whose search
  /// ended although it came first has all of the time again only after some cycles, so that others have it meanwhile.
  double max_time = 0.0;

  /// Only pairs that stay farther apart than this are CLEAR [m]; those that come closer are UNCERTAIN, and so are
  /// contacts that are less deep. Error bounds do not contain it. From 0 to kLargestMargin.
  double margin = 0.0;

  PairTimes* times = nullptr;  ///< receives the time that each pair takes; null: it is not measured

  /// Whether contacts are computed, for themselves or for something else.
  bool wantsContacts() const { return contacts || wantsPoints(); }

  /// Whether points of shells are queried in fields: they bear the forces.
  bool wantsPoints() const { return wrenches || max_points > 0; }
};

/// One contact of one shell point.
struct ContactPoint {
  double enter = 0.0;  ///< [s] from t₀
  double exit = 0.0;   ///< [s] from t₀
  double time = 0.0;   ///< when it is deepest [s] from t₀
  double depth = 0.0;  ///< [m]
  /// Of the depth [m], from the field at this point: mostly less than ErrorSources::field. Beyond the band the point
  /// may get deeper at another time by up to this. If the surfaces cross without any point inside, the depth is 0, and
  /// they are no deeper than this. In a body of several parts the depth is that in one of them; where parts meet, the
  /// body may be deeper by up to this, but is never less deep by more than the field's error.
  double depth_error = 0.0;
  Vector3d p_W = Vector3d::Zero();       ///< when deepest [m]
  Vector3d normal_W = Vector3d::Zero();  ///< unit, from body A to body B
};

/// What a cycle says about one pair.
struct PairResult {
  int body_a = -1;
  int body_b = -1;
  Verdict verdict = Verdict::kNotChecked;
  std::string reason;    ///< why it was not checked, is incomplete, or has no force (wrenches are NaN); else empty
  WaypointSpan span;     ///< the part of the motion that was checked; empty if the pair is delayed
  bool skipped = false;  ///< CLEAR without a test, by the clearance known from an earlier cycle
  /// UNCERTAIN because no time was left to test it: by what is known from earlier cycles, the bodies overlap by no more
  /// than the error.
  bool postponed = false;
  /// CONTACT, but no time was left to compute it: `reason` tells what is missing. If that is its times, depth and
  /// force, the only interval is the whole span, during which it touches at `deepest` at least; its depth is up to
  /// deepest.depth + depth_error, the greatest that the bodies allow; there are no points, and wrenches are NaN.
  bool incomplete = false;
  ErrorSources error;          ///< of the verdict
  ErrorSources contact_error;  ///< of what fields and shells tell: points and, unless measured, intervals and depths;
                               ///< zero if they tell nothing
  double clearance = 0.0;      ///< lower bound of the distance at the span's end, the motion's error taken off [m];
                               ///< negative if not known. See CycleRequest::skipped_pairs
  std::vector<Interval> intervals;  ///< of any contact, φ ≤ 0 [s] from t₀
  /// Valid if intervals is not empty; beyond the band, its error holds for all points. If measured, no point of either
  /// surface gets deeper than this depth by more than depth_error within the span.
  ContactPoint deepest;
  /// Whether intervals and depths were measured on the surfaces: those of bodies with certain solids. The others' come
  /// from fields and shells.
  bool measured = false;
  /// If measured, and the surfaces meet: the bodies are apart before `enter`, where the first interval begins, and
  /// certainly touch by `exit`, which is infinite if no certain crossing was found. Not set if one body may be inside
  /// the other at the start, unless that is a half-space.
  std::optional<Interval> first_touch;
  /// Likewise: they certainly touch at `enter`, which may be −∞, and are apart after `exit`, where the last interval
  /// ends.
  std::optional<Interval> last_touch;
  Wrench on_a_W;  ///< average over the span, world axes, about A's origin at its end
  Wrench on_b_W;  ///< the same on B, about B's origin
  std::vector<ContactPoint> points;
  /// Of each interval with shell points inside the deepest one, of others a crossing of the surfaces; in any order.
  std::vector<ContactPoint> peaks;
};

/// What a cycle says about all pairs.
struct CycleResult {
  std::vector<PairResult> pairs;           ///< in the order of Scene::pairs
  std::vector<int> not_clear;              ///< indices of those that are neither CLEAR nor delayed, increasing
  std::vector<int> failed;                 ///< not in not_clear: NOT_CHECKED in all cycles, as a body was not built
  Verdict verdict = Verdict::kNotChecked;  ///< worst of all pairs: CONTACT, UNCERTAIN, NOT_CHECKED, CLEAR;
                                           ///< NOT_CHECKED if there are none, or some are delayed and the others CLEAR
  double error_bound = 0.0;                ///< largest of the pairs checked [m]
  ErrorSources error;                      ///< of that pair, by source
  double contact_error = 0.0;              ///< largest PairResult::contact_error of all pairs [m]
  int checked = 0;
  int skipped = 0;
  int not_checked = 0;
  int delayed = 0;
  int postponed = 0;
  int incomplete = 0;     ///< of those checked
  double run_time = 0.0;  ///< [s]
};

/// Range of MonitorOptions::max_error [m].
///@{
constexpr double kMinMaxError = 1e-5, kLargestMaxError = 1e-2;
///@}

/// How a Monitor checks; the same for all of its cycles.
struct MonitorOptions {
  ContactOptions contact;
  ChordOptions chords;

  /// Surfaces are proved to be apart if they come no closer than half of this plus the errors of the motions and the
  /// triangles; pairs that come closer may stay UNCERTAIN [m]. From kMinMaxError to kLargestMaxError.
  double max_error = 1e-4;
};

/// Scratch memory of checks, which is reused. Several monitors that run at the same time may share it; its size depends
/// on how many pairs are checked at the same time.
struct MonitorMemory;
/// For monitors that are to share it.
std::shared_ptr<MonitorMemory> makeMonitorMemory();

class SceneDifference;

/// A monitor's data for another scene, made in advance by Monitor::prepare(); after Monitor::adopt(), the data that the
/// monitor no longer needs. Destroy it on a thread that is not time-critical.
class MonitorChange {
 public:
  ~MonitorChange();

  /// What the scene has in common with the previous one.
  const SceneDifference& difference() const;

 private:
  friend class Monitor;
  struct Impl;
  explicit MonitorChange(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Checks all pairs of a scene cycle by cycle, and remembers their clearances.
///
/// Surfaces decide (meshes, voxels, primitives: Body::triangles, and half-spaces). Two bodies are CLEAR if their
/// surfaces are proved to stay farther apart than the error of the motions, and no part of one is wholly inside the
/// other. They are in CONTACT if the surfaces certainly cross at some time, or a point of one is certainly inside the
/// other. This holds to MonitorOptions::max_error (src/surface/separation.h; design §3.17); what comes too close
/// to decide is UNCERTAIN, as is what may have come through the opening of a mesh. PairResult::error is that of the
/// triangles and motions, for an UNCERTAIN pair plus the distance within which it is open. Pairs are NOT_CHECKED if a
/// body is missing or beyond kFarthestPose, or both have half-spaces.
///
/// Fields and shells give the contacts: times, depths and forces, with the error PairResult::contact_error. Both
/// bodies' shells are tested where both exist, and their impulses are weighted so that a contact that both see counts
/// once. Wrenches are integrated in the world's axes about A's origin at the end. A pair of which neither body can have
/// a shell (two maps, a map and a half-space) has contacts without force.
///
/// A CLEAR pair is not tested again until its bodies can have used up the distance between them. Skipping costs some
/// nanoseconds per pair and cycle and is as safe as a test, even if a motion does not begin where the last one ended.
/// Any other pair is not tested again while its bodies do not move relative to each other, by no monitor of the scene:
/// Scene::resting.
///
/// In a field with openings, a point may be inside only because of a cap, or may have come there through an opening:
/// unless the surfaces certainly cross, its depth_error is no less than its depth, and it bears no force except where
/// it may be just touching the mesh. Depths to a cap never bear force. A crossing without any hit (of a sheet, which
/// has no inside) is a contact of zero duration and depth.
///
/// After the first cycles no memory is allocated unless contacts or the number of chords grow, or another thread joins
/// the arena (it allocates its scratch memory once). Contacts are merged as they are found, so memory is that of a few
/// chords, however many chords and points touch. Pairs run in parallel on the caller's TBB arena; results do not depend
/// on the number of threads. Not thread-safe: one cycle at a time.
///
/// The scene may change between two cycles: another thread prepares the next one while cycles run, and adopt() switches
/// to it. Everything known about a pair is kept if its two bodies are the same in both scenes (BodyList::shared()) and
/// are tested in the same way; about new or changed pairs nothing is known. adopt() moves this knowledge, by pointers
/// where possible: it frees and allocates nothing. Verdicts are those of a monitor newly made for the scene.
class Monitor {
 public:
  /// @param memory  to be shared with other monitors; null: its own.
  /// @throws std::invalid_argument if the options are not valid.
  Monitor(std::shared_ptr<const Scene> scene, const MonitorOptions& options,
          std::shared_ptr<MonitorMemory> memory = nullptr);
  /// For bodies that are already prepared: see makeScene().
  explicit Monitor(std::vector<Body> bodies, const MonitorOptions& options = {});
  ~Monitor();

  /// @return the result, valid until the next run() or check(), which reuses its memory: copy what must be kept.
  /// @throws std::invalid_argument if the motion's sizes do not fit the scene or its times do not increase.
  const CycleResult& run(const CycleMotion& motion, const CycleRequest& request);

  /// The same for bodies whose poses are all given at the same times. Between two poses a body takes the shorter
  /// rotation: rotations of half a revolution and more need poses in between.
  /// @param X_WB      per body: poses of its own frame B, two or more; Body::X_frame_B is not applied.
  /// @param duration  from the first poses to the last; those between are evenly spaced [s].
  /// @throws std::invalid_argument also if bodies have different numbers of poses, or two poses of a body leave the
  /// direction of its rotation open (kAmbiguousTurn).
  const CycleResult& check(const std::vector<std::vector<Isometry3d>>& X_WB, double duration = 1.0,
                           const CycleRequest& request = {});

  /// Prepares the switch to another scene. May be called from any thread, also while a cycle runs, but not during
  /// adopt().
  /// @param likely  a motion of the next scene's bodies; its spans are ignored. Pairs about which nothing is known are
  /// tested over it, so that the first cycle after adopt() need not test them, unless they are near or the bodies are
  /// elsewhere then. Null: that cycle tests them all.
  /// @throws std::invalid_argument if the motion does not fit the scene.
  std::unique_ptr<MonitorChange> prepare(std::shared_ptr<const Scene> next, const CycleMotion* likely = nullptr) const;

  /// Switches to a prepared scene, between two cycles. What run() returned is no longer valid.
  /// @param change  from prepare() of this monitor, since the last adopt(). @throws std::logic_error otherwise.
  void adopt(MonitorChange& change);

  /// Forgets all clearances, as when time jumps.
  void reset();

  /// The scene that the next cycle checks.
  const Scene& scene() const;

 private:
  friend class MonitorChange;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Distance from a point to the nearest body at given poses; for the point queries. For a mesh with openings, the error
/// covers that the point may be on either side, and that the nearest surface may be a cap: see
/// DistanceField::meshSample(). Within a body of several elements, the distance and its gradient are those of one
/// element; where elements meet, the surface of the body is farther away, and the error covers that.
struct NearestBody {
  int body = -1;          ///< -1 if no body is known
  double distance = 0.0;  ///< [m], negative inside
  double error = 0.0;     ///< [m]; infinite if bodies are known by their boxes only
  Vector3d gradient_W = Vector3d::Zero();
};

/// Triangles of meshes that have no field, each prepared when it is first needed and kept as long as the mesh is in
/// use. Several searches may share them, in several threads.
class MeshDistances;
/// None yet.
std::shared_ptr<MeshDistances> makeMeshDistances();
/// Frees what was prepared of meshes that are gone; each new search does so too.
void dropUnused(MeshDistances& meshes);

/// Finds the nearest body to points. A body with a distance field is as far as that says; all others are as far as
/// their primitives and the triangles of their meshes are, which need no field.
class NearestBodySearch {
 public:
  /// @param description  of the scene.
  /// @param meshes       null: they are not shared.
  NearestBodySearch(std::shared_ptr<const Scene> scene, std::shared_ptr<const SceneDescription> description,
                    std::shared_ptr<MeshDistances> meshes = nullptr);
  ~NearestBodySearch();

  /// Prepares the meshes of one body, if it has no field. Takes some ten microseconds per triangle the first time.
  /// @return what is uncertain about the body's inside, or why it is left out; empty if there is nothing to say.
  std::string prepare(std::size_t body);

  /// Whether the body is left out: it has no geometry, or is bad, or is not prepared.
  bool isIgnored(std::size_t body) const;

  /// The nearest of the bodies that are prepared. @param X_WB  per body of the scene.
  NearestBody nearest(const std::vector<Isometry3d>& X_WB, const Vector3d& p_W) const;

 private:
  class Element;

  static double greatestDepth(const std::vector<Element>& elements, const Vector3d& p_B);

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const SceneDescription> description_;
  std::shared_ptr<MeshDistances> meshes_;
  std::vector<std::vector<Element>> elements_;  // per body; empty until it is prepared
};

}  // namespace sdf_ccd
