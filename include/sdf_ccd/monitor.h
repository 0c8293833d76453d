#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/body.h"
#include "sdf_ccd/result.h"
#include "sdf_ccd/scene.h"
#include "sdf_ccd/segments.h"
#include "sdf_ccd/trajectory.h"

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

/// One contact of a pair of bodies, over however many cycles. Times are since the clock's epoch. For tiles of a map
/// that changes (see VoxelMap) the other body is the map.
struct TrackedContact {
  /// Since the clock's epoch.
  using Time = std::chrono::nanoseconds;

  std::uint64_t id = 0;  ///< from 1, in the order in which contacts begin; never reused
  std::string body_a, body_b;
  bool begins = false;   ///< it began in the last cycle
  bool ends = false;     ///< it ended in the last cycle; both if it lasted for a part of the cycle
  bool is_lost = false;  ///< it ended because the pair's state became unknown: the bodies may still touch
  Verdict verdict = Verdict::kUncertain;  ///< kContact if the pair was in CONTACT during it, in any cycle
  Time begin{0};                          ///< first time at which it was seen
  Time end{0};                            ///< last time at which it was seen, up to now
  ContactPoint deepest;                   ///< of all cycles; its times are relative to `deepest_origin`
  Time deepest_origin{0};
  double error_bound = 0.0;      ///< of the verdict, largest of its cycles [m]
  double contact_error = 0.0;    ///< of times and depths, largest of its cycles [m]
  double max_force = 0.0;        ///< largest mean force of a cycle while it touched [N]; 0 if wrenches are not wanted,
                                 ///< NaN if that of a cycle is not known (PairResult::incomplete)
  std::uint32_t cycles = 0;      ///< number of cycles in which it was seen
  bool seen_at_samples = false;  ///< a check of the recorded poses alone would have seen it
};

/// A cycle through which contacts are tracked.
struct ObservedCycle {
  const CycleResult& result;
  const CycleMotion& motion;
  const std::vector<double>& samples;  ///< times of the recorded poses [s] from t₀, increasing
  std::chrono::nanoseconds origin;     ///< t₀
};

/// Which breaks of a contact do not end it, so that noise of poses does not make many contacts of one.
struct ContactJoin {
  std::chrono::nanoseconds time{1000000};  ///< breaks up to this long are none: rounding and field cells cause them
  /// But a break is one if the bodies are known to be farther apart than this at the end of a cycle in it [m].
  double distance = std::numeric_limits<double>::infinity();
};

/// Tracks contacts over time: joins contacts that the ends of cycles have cut, under an id that stays as long as the
/// contact lasts.
///
/// A contact lasts while the pair's distance is at or below zero. It continues across the breaks that ContactJoin names
/// and across the ends of cycles, also across delayed cycles and changes of the world, because pairs are identified by
/// their bodies' names. It ends when the pair has been checked for longer than a break without touching. If the pair is
/// not checked for some time, or no longer, it ends as lost.
///
/// A body and all tiles of a map count as one pair: sliding from one tile to another, or touching a tile that is
/// replaced, is one contact. It continues as long as one of the tiles is touched.
///
/// If a cycle checks earlier times again, because transforms came late, a contact found there joins the one of the pair
/// that it meets, even if that had ended, which is then listed once more. If it meets none of the last two seconds and
/// lies before the last one, it has ended, and the last one continues. Earlier messages are not corrected.
///
/// The cost of a cycle grows with the pairs that are not CLEAR and with the existing contacts. Memory is
/// allocated only if a pair touches for the first time, or more contacts begin in two seconds than ever before.
class ContactTracker {
 public:
  /// The break that never ends a contact.
  static constexpr std::chrono::nanoseconds kJoin = ContactJoin().time;

  /// Of a scene's pairs; no contact yet.
  explicit ContactTracker(const Scene& scene, const ContactJoin& join = {});
  ~ContactTracker();

  /// What the tracker needs for another world.
  struct Change;
  /// Makes it while cycles run, from any thread, but not during adopt().
  std::shared_ptr<Change> prepare(const Scene& next) const;

  /// Switches to another world between two cycles. Contacts of pairs that it has too continue; others end as lost, and
  /// are listed with the next cycle. The cost grows with the contacts; no memory is freed or allocated.
  /// `change` is from prepare(), called since the last adopt(), and receives the data of the previous world.
  ///@{
  void adopt(Change& change);
  void adopt(const Scene& scene);
  ///@}

  /// Processes the next cycle of the adopted scene; all contacts must be computed (CycleRequest::contacts).
  void update(const ObservedCycle& cycle);

  /// To be called when a cycle is over: contacts no longer count as begun, and those that have ended are no longer
  /// listed.
  void clearEvents();

  /// Ends all contacts as lost, for example after a jump of time.
  void endAllAsLost();

  /// The contacts of the last cycle, including those that ended in it. Valid until the next call.
  ///@{
  std::size_t size() const;
  const TrackedContact& operator[](std::size_t i) const;
  ///@}

  /// Number of contacts that have not ended.
  std::size_t open() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sdf_ccd
