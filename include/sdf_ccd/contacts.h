#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

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

/// Whether the interval contains one of the samples.
bool holdsSample(const Interval& interval, const std::vector<double>& samples);

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
/// If a cycle checks earlier times again, because transforms came late, a contact found there joins the pair's last one
/// if the two meet, even if that had ended. One that lies before the last one has ended, and the last one continues.
/// Earlier messages are not corrected.
///
/// The cost of a cycle grows with the pairs that are not CLEAR and with the existing contacts. Memory is
/// allocated only if a pair touches for the first time, or more pairs touch at a time than ever before.
class ContactTracker {
 public:
  /// The break that never ends a contact.
  static constexpr std::chrono::nanoseconds kJoin = ContactJoin().time;

  /// Of a scene's pairs; no contact yet.
  explicit ContactTracker(const Scene& scene, const ContactJoin& join = {}) : join_(join) { adopt(scene); }

  /// Groups of pairs that are tracked as one.
  struct Groups {
    std::vector<std::pair<std::string, std::string>> keys;  ///< per group: keys of its bodies, or body and map
    std::vector<int> of_pair;                               ///< per pair of the scene
    std::vector<int> begin;                                 ///< per group, plus one: first index in `pairs`
    std::vector<int> pairs;                                 ///< group by group
  };

  /// What the tracker needs for another world; prepared while cycles run.
  struct Change {
    Groups groups;
    std::vector<int> last, listed;
    std::vector<int> groups_now;  ///< per present group: its index in the next world; -1 if it has none
  };
  /// Makes it, from any thread, but not during adopt().
  Change prepare(const Scene& next) const;

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
  std::size_t size() const { return listed_.size(); }
  const TrackedContact& operator[](std::size_t i) const { return slots_[static_cast<std::size_t>(listed_[i])].contact; }
  ///@}

  /// Number of contacts that have not ended.
  std::size_t open() const { return open_; }

 private:
  using Time = std::chrono::nanoseconds;

  struct Slot {
    TrackedContact contact;
    int group = -1;          // group of pairs; −1: free
    bool is_open = false;    // it has not ended
    bool was_apart = false;  // the bodies were farther apart than ContactJoin::distance after it
    bool is_listed = false;
    bool is_unreported = false;  // it ended with its world, after the last cycle
    bool has_deepest = false;
    bool deepest_is_certain = false;  // it is of a cycle in which the contact was certain
    double max_depth = 0.0;           // upper bound of the depth of its points or, where measured, of all [m]
    std::uint64_t cycle = 0;          // last cycle in which it was seen
  };

  struct TouchInterval {  // one interval of a pair in a cycle
    int group;
    double enter;  // [s]
    int pair, interval;
  };

  static double exitOf(const CycleResult& result, const TouchInterval& touch);
  void addTouch(const ObservedCycle& cycle, const TouchInterval& touch, Slot& slot);
  void closeIfOver(const ObservedCycle& cycle, Slot& slot);
  Slot& slotFor(std::size_t group, Time start, Time end);
  Time longestBreak(const Slot& slot) const { return slot.was_apart ? std::min(kJoin, join_.time) : join_.time; }
  void close(Slot& slot, bool is_lost);
  void list(int index);
  void listUnreported();

  ContactJoin join_;
  Groups groups_;
  std::vector<int> last_;  // per group: slot of its last contact; −1: none
  std::vector<Slot> slots_;
  std::vector<int> free_;
  std::vector<int> listed_;
  std::vector<int> unreported_;         // to be listed with the next cycle
  std::vector<TouchInterval> touches_;  // of the cycle
  std::size_t open_ = 0;
  std::uint64_t next_id_ = 1;
  std::uint64_t cycle_ = 0;
};

}  // namespace sdf_ccd
