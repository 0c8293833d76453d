#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// What one pair did without a break, over however many cycles. Times are since the clock's epoch. Of tiles of a map
/// that changes (see VoxelMap) the other body is the map.
struct TrackedContact {
  using Time = std::chrono::nanoseconds;

  std::uint64_t id = 0;  ///< from 1, in the order in which contacts begin; never used again
  std::string body_a, body_b;
  bool begins = false;                    ///< in the last cycle
  bool ends = false;                      ///< the same; both if it lasted for a part of it
  bool is_lost = false;                   ///< it ends as nothing is known of the pair any more: it may go on
  Verdict verdict = Verdict::kUncertain;  ///< kContact if the pair's was, in a cycle, for this
  Time begin{0};                          ///< from when on it was seen
  Time end{0};                            ///< up to when, until now
  ContactPoint deepest;                   ///< of all cycles; its times count from `deepest_origin`
  Time deepest_origin{0};
  double error_bound = 0.0;    ///< of the verdict, largest of its cycles [m]
  double contact_error = 0.0;  ///< of times and depths, largest of its cycles [m]
  double max_force = 0.0;      ///< largest of its cycles' mean forces while it touched [N]; 0 if wrenches are not known
  std::uint32_t cycles = 0;    ///< in which it was seen
  bool seen_at_samples = false;  ///< by a check at the recorded poses alone
};

/// A cycle, as contacts are followed through it.
struct ObservedCycle {
  const CycleResult& result;
  const CycleMotion& motion;
  const std::vector<double>& samples;  ///< times of the recorded poses [s] from t₀, increasing
  std::chrono::nanoseconds origin;     ///< t₀
};

/// Whether an interval holds one of the samples.
bool holdsSample(const Interval& interval, const std::vector<double>& samples);

/// Contacts over time: makes one of what cycles cut, with an id that stays as long as the contact does.
///
/// A contact is a stay of a pair's distance at or below zero. It goes on as long as breaks are no longer than kJoin
/// (shorter ones are of rounding, or of a field's cells), whatever the cycles' ends; also over cycles that are delayed,
/// and if the world changes, as pairs are known by their bodies' names. It ends when the pair was checked for
/// longer than that and not seen to touch. If the pair is not checked over some time, or not any more, it ends as lost.
///
/// A body and all tiles of a map are one pair here: what slides from one tile over another, and what touches a tile
/// that is made anew, is one contact. It goes on as long as one of them is touched.
///
/// Where a cycle checks earlier times again, as transforms came late, what it finds there joins the pair's last contact
/// if it meets it, even if that had ended. What was said before is not taken back.
///
/// A cycle costs what touches: of a cycle that is CLEAR only contacts that were there are looked at. Nothing is
/// allocated unless a pair touches for the first time, or more do at a time than ever before.
class ContactTracker {
 public:
  static constexpr std::chrono::nanoseconds kJoin{1000000};

  explicit ContactTracker(const Scene& scene) { adopt(scene); }

  /// Pairs that are one here.
  struct Groups {
    std::vector<std::pair<std::string, std::string>> keys;  ///< per group: what tells its bodies, or map, from others
    std::vector<int> of_pair;                                ///< per pair of the scene
    std::vector<int> begin;                                  ///< per group, and one more: in `pairs`
    std::vector<int> pairs;                                  ///< of one group after the other
  };

  /// What another world needs, to be made beside running cycles.
  struct Change {
    Groups groups;
    std::vector<int> last, listed;
    std::vector<int> groups_now;  ///< per group until now; -1 if the next world does not hold it
  };
  Change prepare(const Scene& next) const;

  /// Takes another world over between two cycles. Contacts of pairs that it holds too go on; others end as lost, and
  /// are listed with the next cycle. Costs what touches; frees and allocates nothing.
  /// @param change  that prepare() made since the last call; afterwards what was before.
  void adopt(Change& change);
  void adopt(const Scene& scene);

  /// Takes the next cycle of the adopted scene, all contacts computed (CycleRequest::contacts).
  void update(const ObservedCycle& cycle);

  /// No cycle has come since: nothing begins or ends.
  void settle();

  /// Nothing goes on from here, as when time jumps back: all contacts end as lost.
  void lose();

  /// All that were there in the last cycle, those included that ended in it. Holds until the next call.
  std::size_t size() const { return listed_.size(); }
  const TrackedContact& operator[](std::size_t i) const { return contacts_[static_cast<std::size_t>(listed_[i])].said; }

  /// How many go on.
  std::size_t open() const { return open_; }

 private:
  using Time = std::chrono::nanoseconds;

  struct Slot {
    TrackedContact said;
    int group = -1;        // of pairs; −1: free
    bool is_open = false;  // it goes on
    bool is_listed = false;
    bool is_unsaid = false;  // it ended with its world, and no cycle has come since
    bool has_deepest = false;
    double reach = 0.0;       // where refined: no place gets deeper [m]
    std::uint64_t cycle = 0;  // in which it was seen last
  };

  struct Stay {  // of a pair in a cycle
    int group;
    double enter;  // [s]
    int pair, interval;
  };

  void takeStay(const ObservedCycle& cycle, const Stay& stay);
  void closeIfOver(const ObservedCycle& cycle, Slot& slot);
  Slot& slotFor(std::size_t group, Time start, Time end);
  void close(Slot& slot, bool is_lost);
  void list(int slot);
  void sayUnsaid();

  Groups groups_;
  std::vector<int> last_;  // per group: slot of its last contact; −1: none
  std::vector<Slot> contacts_;
  std::vector<int> free_;
  std::vector<int> listed_;
  std::vector<int> unsaid_;  // to be listed with the next cycle
  std::vector<Stay> stays_;  // of the cycle
  std::size_t open_ = 0;
  std::uint64_t next_id_ = 1;
  std::uint64_t cycle_ = 0;
};

}  // namespace sdf_ccd
