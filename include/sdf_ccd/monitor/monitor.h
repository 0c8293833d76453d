#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/contact/penalty.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/motion/cycle_motion.h"
#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

/// What contacts are measured on beyond fields and shells.
enum class Refinement {
  kNone,
  /// How deep a contact gets, where and when, and when it begins, on the triangles of both bodies. Of pairs of closed
  /// bodies that are all triangles, of a scene with BodyOptions::exact_depths; others stay as they are.
  kDeepest,
};

/// What a cycle is asked for; what nobody reads is not computed.
struct CycleRequest {
  bool wrenches = true;
  int max_points = 0;  ///< contact points listed per pair, the deepest first

  /// Whether `clearance` and `error` of pairs that are skipped are those of this cycle. Else they are what holds as
  /// long as the pair is skipped, and what held when it began to be: a cycle touches only pairs that it tests then.
  bool skipped_pairs = true;

  /// Intervals and deepest points; wrenches and points ask for them too. Else a pair whose surfaces are found to cross
  /// has one interval and deepest point, the time and place where they were, without a depth; no field is asked.
  bool contacts = true;

  /// When that much of the cycle's time is up, no other pair is tested [s], but one in every cycle; 0: no limit. Those
  /// that are left are PairResult::postponed, and the first to be tested in the next cycle.
  double max_time = 0.0;

  Refinement refine = Refinement::kNone;  ///< of contacts, where these are wanted

  bool wantsContacts() const { return contacts || wrenches || max_points > 0; }
};

/// One contact of one shell point.
struct ContactPoint {
  double enter = 0.0;               ///< [s] from t₀
  double exit = 0.0;                ///< [s] from t₀
  double time = 0.0;                ///< when it is deepest [s] from t₀
  double depth = 0.0;               ///< [m]
  double depth_error = 0.0;         ///< of the depth, from the field there [m]: mostly less than ErrorBound::field,
                                    ///< beyond its band more
  Vector3d p_W = Vector3d::Zero();  ///< when deepest [m]
  Vector3d normal_W = Vector3d::Zero();  ///< unit, from body A to body B
};

struct PairResult {
  int body_a = -1;
  int body_b = -1;
  Verdict verdict = Verdict::kNotChecked;
  std::string reason;        ///< why it was not checked; empty if it was
  WaypointSpan span;         ///< the part of the motion that this is about; empty if the pair is delayed
  bool skipped = false;      ///< clear by the clearance left from an earlier cycle
  /// UNCERTAIN, as no time was left for it: by what earlier cycles knew the bodies overlap by no more than the error.
  bool postponed = false;
  ErrorBound error;          ///< of the verdict
  ErrorBound contact_error;  ///< of intervals and depths, which fields and shells tell; zero where there are none
  double clearance = 0.0;    ///< a lower bound of the distance at the span's end, whatever the motion is off
                             ///< by [m]; negative if not known. See CycleRequest::skipped_pairs
  std::vector<Interval> intervals;  ///< of any contact, φ ≤ 0 [s] from t₀
  ContactPoint deepest;             ///< valid if intervals is not empty. Its depth_error, where refined: no place
                                    ///< of either surface gets deeper into the other body by more in this span
  bool refined = false;             ///< see CycleRequest::refine: the deepest point is of triangles
  /// Where refined, and the surfaces cross: the bodies are apart before `enter`, and surely touch by `exit`. The first
  /// interval begins between them. `exit` is infinite if no certain crossing was found. None where one body may be
  /// inside the other at first.
  std::optional<Interval> first_touch;
  Wrench on_a_W;                    ///< average over the span, world axes, about A's origin at its end
  Wrench on_b_W;                    ///< the same on B, about B's origin
  std::vector<ContactPoint> points;
};

struct CycleResult {
  std::vector<PairResult> pairs;           ///< in the order of Scene::pairs
  Verdict verdict = Verdict::kNotChecked;  ///< worst of all pairs: CONTACT, UNCERTAIN, NOT_CHECKED, CLEAR;
                                           ///< NOT_CHECKED if there are none, or some are delayed and the others CLEAR
  double error_bound = 0.0;                ///< largest of the pairs checked [m]
  ErrorBound error;                        ///< of that pair, by source
  double contact_error = 0.0;              ///< largest PairResult::contact_error of all pairs [m]
  int checked = 0;
  int skipped = 0;
  int not_checked = 0;
  int delayed = 0;
  int postponed = 0;
  double run_time = 0.0;  ///< [s]
};

constexpr double kLeastMaxError = 1e-5, kLargestMaxError = 1e-2;  // [m]

struct MonitorOptions {
  ContactOptions contact;
  ChordOptions chords;

  /// Where triangles decide about a pair, surfaces that come no nearer than half of this, beyond what the motions and
  /// the triangles are off by, are told apart; what comes nearer may stay UNCERTAIN [m]. From kLeastMaxError to
  /// kLargestMaxError.
  double max_error = 1e-4;
};

/// What checks need while they run, to be used again. Monitors of which several run at a time may share one; there is
/// as much of it as there are pairs that are checked at the same time.
struct MonitorMemory;
std::shared_ptr<MonitorMemory> makeMonitorMemory();

class SceneDifference;

/// What another scene needs of a monitor, made ahead by Monitor::prepare(); after Monitor::adopt() what the monitor no
/// longer needs. To be destroyed by a thread that has the time for it.
class MonitorChange {
 public:
  ~MonitorChange();

  /// What the scene has in common with the one before.
  const SceneDifference& difference() const;

 private:
  friend class Monitor;
  struct Impl;
  explicit MonitorChange(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Runs cycles over all pairs of a scene and remembers how far apart they were.
///
/// Two bodies that are all triangles (meshes, boxes, cylinders, balls: Body::triangles) are CLEAR if their surfaces are
/// proved to stay farther apart than the motions are known to, and no part of one is wholly inside the other, and in
/// CONTACT if the surfaces surely cross at some time: to MonitorOptions::max_error, whatever fields and shells are
/// (src/query/separation.h; design §3.17). PairResult::error is that of the triangles and motions then; of a pair that
/// is UNCERTAIN as its surfaces come nearer than can be told, max_error more. What is left open otherwise
/// (a body may be wholly inside the other, or have come through the opening of a mesh) is the fields' and shells', and
/// so are depths and forces, which are off by PairResult::contact_error.
///
/// Else a pair is CLEAR if no shell point comes nearer than the error bound's total, CONTACT if one is surely deeper,
/// by what the field knows where it is, than the errors of chord and root, else UNCERTAIN; NOT_CHECKED if a body is
/// missing, beyond kFarthestPose, or the bound infinite. Both bodies' shells are tested where both exist, and their
/// impulses weighted, so that what both see counts once. Where the bound exceeds a band, the field's lower bounds
/// decide about CLEAR. Wrenches are integrated in the world's axes about A's origin at the end.
///
/// A pair that is CLEAR is not tested again before its bodies can have used up the distance between them: some
/// nanoseconds per pair and cycle, never less safe than a test. It holds also if a motion does not begin where the last
/// one ended.
///
/// In a field with openings a place may be inside because a cap makes it so, or have come there through an opening.
/// What its hits alone say is UNCERTAIN, with a depth_error no less than the depth, and bears no force, unless it may
/// be that the point just touches. CONTACT there needs that a point surely passes through the mesh, in or out, or that
/// triangles of both bodies surely cross at a recorded time (surface_crossing.h); then depths to the mesh, not to a
/// cap, bear force. A crossing without any hit (of a sheet, which has no inside) is a contact of no length and depth.
///
/// A body that lies wholly inside another touches no surface: points of its shell show that, or, of a body without one
/// (a voxel map, whatever shares a body with one or with a half-space), one point of each of its components. Such a
/// contact of a body without a shell has a depth, but bears no force.
///
/// After the first cycles no memory is allocated unless contacts or the number of chords grow, or another thread joins
/// the arena (it makes its scratch memory once). However many chords touch however many points, what is known of them
/// is put together as it comes: memory is as that of a few chords. Pairs run in parallel on the caller's TBB arena;
/// results do not depend on the number of threads. Not thread-safe: one cycle at a time.
///
/// The scene may change between two cycles: another thread prepares the next one while cycles run, and adopt() takes it
/// over. Of a pair whose two bodies are the same in both (BodyList::shared()), tested in the same way, all that is known
/// stays; what is new or has changed begins unknown. adopt() moves what is known, pointer by pointer where it can: it
/// frees nothing, and allocates nothing. Verdicts are those of a monitor made anew of the scene.
class Monitor {
 public:
  /// @param memory  to be shared with other monitors; null: its own.
  /// @throws std::invalid_argument if the options are not valid.
  Monitor(std::shared_ptr<const Scene> scene, const MonitorOptions& options,
          std::shared_ptr<MonitorMemory> memory = nullptr);
  /// Of bodies that are prepared already: see makeScene().
  explicit Monitor(std::vector<Body> bodies, const MonitorOptions& options = {});
  ~Monitor();

  /// @return what holds until the next run() or check(), which uses its memory again: copy what is to be kept.
  /// @throws std::invalid_argument if the motion's sizes do not fit the scene or its times do not increase.
  const CycleResult& run(const CycleMotion& motion, const CycleRequest& request);

  /// The same for bodies that are all known at the same times. Between two poses a body turns the shorter way round:
  /// turns of half a revolution and more need poses in between.
  /// @param X_WB      per body: poses of its own frame B, two or more; Body::X_frame_B is not applied.
  /// @param duration  from the first poses to the last; those between are evenly spaced [s].
  /// @throws std::invalid_argument also if bodies have different numbers of poses, or two poses of a body do not tell
  /// which way it turned (kAmbiguousTurn).
  const CycleResult& check(const std::vector<std::vector<Isometry3d>>& X_WB, double duration = 1.0,
                           const CycleRequest& request = {});

  /// Makes what another scene needs. From any thread, also while a cycle runs, but not while adopt() does.
  std::unique_ptr<MonitorChange> prepare(std::shared_ptr<const Scene> next) const;

  /// Takes over a scene between two cycles. What run() returned is no longer valid.
  /// @param change  that prepare() made of this monitor, since the last adopt(). @throws std::logic_error otherwise.
  void adopt(MonitorChange& change);

  /// Forgets all clearances, as when time jumps.
  void reset();

  const Scene& scene() const;

 private:
  friend class MonitorChange;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Distance from a point to the nearest body at given poses; for the point queries. Of a mesh with openings the error
/// covers that the point may be on either side, and that the nearest surface may be a cap: see
/// DistanceField::meshSample().
struct NearestBody {
  int body = -1;          ///< -1 if no body has a field
  double distance = 0.0;  ///< [m], negative inside
  double error = 0.0;     ///< [m]
  Vector3d gradient_W = Vector3d::Zero();
};
NearestBody nearestBody(const Scene& scene, const std::vector<Isometry3d>& X_WB, const Vector3d& p_W);

}  // namespace sdf_ccd
