#include "sdf_ccd/monitor.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contact_groups.h"
#include "pair_result.h"
#include "scene_difference.h"

namespace sdf_ccd {

namespace {

using Time = std::chrono::nanoseconds;

Time toTime(double seconds) {
  return Time(std::llround(1e9 * seconds));
}

/// Whether a point proves that the pair touches within the interval: it is deep enough, or the surfaces cross there.
bool proves(const PairResult& pair, const ContactPoint& point, const Interval& interval) {
  return isWithin(point, interval) &&
         (point.depth == 0.0 || pair.contact_error.provesContact(point.depth, point.depth_error));
}

/// Whether a contact certainly touches within one of its intervals. Measured ones begin and end where surfaces cross.
bool isProved(const PairResult& pair, const Interval& interval) {
  return pair.measured || proves(pair, pair.deepest, interval) ||
         std::any_of(pair.peaks.begin(), pair.peaks.end(),
                     [&](const ContactPoint& point) { return proves(pair, point, interval); });
}

/// Mean force while the pair touched [N]; results hold the mean over the whole span.
double forceWhileTouching(const ObservedCycle& cycle, const PairResult& pair) {
  double touching = 0.0;
  for (const Interval& interval : pair.intervals) touching += interval.exit - interval.enter;
  const double length = cycle.motion.times[pair.span.last] - cycle.motion.times[pair.span.first];
  return touching > 0.0 ? pair.on_a_W.force.norm() * length / touching : 0.0;
}

}  // namespace

struct ContactTracker::Change {
  ContactGroups groups;
  std::vector<int> last, listed;
  std::vector<int> groups_now;  // per present group: its index in the next world; -1 if it has none
};

struct ContactTracker::Impl {
  explicit Impl(const ContactJoin& join) : join_(join) {}

  struct Slot {
    TrackedContact contact;
    int group = -1;          // group of pairs; −1: free
    bool is_open = false;    // it has not ended
    bool was_apart = false;  // the bodies were farther apart than ContactJoin::distance after it
    bool is_listed = false;
    bool is_unreported = false;  // it ended with its world, after the last cycle
    bool has_deepest = false;
    bool deepest_is_certain = false;  // it is of a cycle in which the contact was certain
    double max_depth = 0.0;           // upper bound of the depth of its points or, where refined, of all [m]
    std::uint64_t cycle = 0;          // last cycle in which it was seen
  };

  struct TouchInterval {  // one interval of a pair in a cycle
    int group;
    double enter;  // [s]
    int pair, interval;
  };

  void adopt(Change& change);
  void update(const ObservedCycle& cycle);
  void clearEvents();
  void endAllAsLost();

  static double exitOf(const CycleResult& result, const TouchInterval& touch);
  void addTouch(const ObservedCycle& cycle, const TouchInterval& touch, Slot& slot);
  void closeIfOver(const ObservedCycle& cycle, Slot& slot);
  Slot& slotFor(std::size_t group, Time start, Time end);
  Slot* endedEarlier(std::size_t group, Time start, Time end);
  int freeSlot(Time start);
  Time longestBreak(const Slot& slot) const { return slot.was_apart ? std::min(kJoin, join_.time) : join_.time; }
  void close(Slot& slot, bool is_lost);
  void list(int index);
  void listUnreported();

  ContactJoin join_;
  ContactGroups groups_;
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

ContactTracker::ContactTracker(const Scene& scene, const ContactJoin& join) : impl_(std::make_unique<Impl>(join)) {
  adopt(scene);
}
ContactTracker::~ContactTracker() = default;

std::shared_ptr<ContactTracker::Change> ContactTracker::prepare(const Scene& next) const {
  auto change = std::make_shared<Change>();
  change->groups = groupsOf(next);
  change->groups_now = findPairs(impl_->groups_.keys, change->groups.keys);
  change->last.assign(change->groups.keys.size(), -1);
  // At most one contact per group, and those that end with the present groups.
  change->listed.reserve(change->groups.keys.size() + 2 * impl_->groups_.keys.size());
  return change;
}

void ContactTracker::adopt(const Scene& scene) {
  adopt(*prepare(scene));
}

void ContactTracker::adopt(Change& change) {
  impl_->adopt(change);
}

void ContactTracker::update(const ObservedCycle& cycle) {
  impl_->update(cycle);
}

void ContactTracker::clearEvents() {
  impl_->clearEvents();
}

void ContactTracker::endAllAsLost() {
  impl_->endAllAsLost();
}

std::size_t ContactTracker::size() const {
  return impl_->listed_.size();
}

const TrackedContact& ContactTracker::operator[](std::size_t i) const {
  return impl_->slots_[static_cast<std::size_t>(impl_->listed_[i])].contact;
}

std::size_t ContactTracker::open() const {
  return impl_->open_;
}

void ContactTracker::Impl::adopt(Change& change) {
  change.listed.assign(listed_.begin(), listed_.end());
  listed_.swap(change.listed);
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    if (slot.group < 0) continue;
    const auto group = static_cast<std::size_t>(slot.group);
    const bool is_last = last_[group] == static_cast<int>(i);
    slot.group = is_last ? change.groups_now[group] : -1;
    if (!is_last) continue;
    if (slot.group >= 0) {
      change.last[static_cast<std::size_t>(slot.group)] = static_cast<int>(i);
      continue;
    }
    // The next world does not have the pair.
    if (slot.is_open) {
      close(slot, true);
      list(static_cast<int>(i));
      slot.is_unreported = true;
    }
    if (!slot.is_listed) free_.push_back(static_cast<int>(i));
  }
  std::swap(groups_, change.groups);
  last_.swap(change.last);
}

void ContactTracker::Impl::clearEvents() {
  for (const int index : listed_) {
    Slot& slot = slots_[index];
    slot.contact.begins = false;
    if (slot.is_unreported) {
      unreported_.push_back(index);
      continue;
    }
    slot.contact.ends = false;
    slot.is_listed = slot.is_open;
    if (!slot.is_open && (slot.group < 0 || last_[slot.group] != index)) free_.push_back(index);
  }
  const auto isOver = [&](int index) { return !slots_[index].is_listed || slots_[index].is_unreported; };
  listed_.erase(std::remove_if(listed_.begin(), listed_.end(), isOver), listed_.end());
}

void ContactTracker::Impl::listUnreported() {
  for (const int index : unreported_) slots_[index].is_unreported = false;
  listed_.insert(listed_.end(), unreported_.begin(), unreported_.end());
  unreported_.clear();
}

void ContactTracker::Impl::endAllAsLost() {
  listUnreported();
  for (const int index : listed_) {
    if (slots_[index].is_open) close(slots_[index], true);
  }
  // Later contacts do not join these.
  std::fill(last_.begin(), last_.end(), -1);
  free_.clear();
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    slots_[i].group = -1;
    slots_[i].is_unreported = false;
    if (!slots_[i].is_listed) free_.push_back(static_cast<int>(i));
  }
}

void ContactTracker::Impl::update(const ObservedCycle& cycle) {
  clearEvents();
  listUnreported();
  ++cycle_;
  touches_.clear();
  for (const int pair : cycle.result.not_clear) {
    const std::vector<Interval>& intervals = cycle.result.pairs[pair].intervals;
    for (std::size_t k = 0; k < intervals.size(); ++k)
      touches_.push_back({groups_.of_pair[pair], intervals[k].enter, pair, static_cast<int>(k)});
  }
  std::sort(touches_.begin(), touches_.end(), [](const TouchInterval& a, const TouchInterval& b) {
    return std::tie(a.group, a.enter, a.pair, a.interval) < std::tie(b.group, b.enter, b.pair, b.interval);
  });
  const auto timeOf = [&](double t) { return cycle.origin + toTime(t); };
  for (auto first = touches_.begin(); first != touches_.end();) {
    // The intervals that meet are of one contact.
    Time end = timeOf(exitOf(cycle.result, *first));
    auto last = first + 1;
    for (; last != touches_.end() && last->group == first->group && timeOf(last->enter) <= end + join_.time; ++last)
      end = std::max(end, timeOf(exitOf(cycle.result, *last)));
    Slot& slot = slotFor(static_cast<std::size_t>(first->group), timeOf(first->enter), end);
    for (; first != last; ++first) addTouch(cycle, *first, slot);
  }
  if (open_ == 0) return;
  for (const int index : listed_) {
    if (slots_[index].is_open) closeIfOver(cycle, slots_[index]);
  }
}

double ContactTracker::Impl::exitOf(const CycleResult& result, const TouchInterval& touch) {
  return result.pairs[touch.pair].intervals[touch.interval].exit;
}

void ContactTracker::Impl::addTouch(const ObservedCycle& cycle, const TouchInterval& touch, Slot& slot) {
  const PairResult& pair = cycle.result.pairs[touch.pair];
  const Interval& interval = pair.intervals[touch.interval];
  const Time start = cycle.origin + toTime(interval.enter), end = cycle.origin + toTime(interval.exit);
  const auto group = static_cast<std::size_t>(touch.group);
  TrackedContact& contact = slot.contact;
  contact.begin = std::min(contact.begin, start);
  contact.end = std::max(contact.end, end);
  contact.cycles += slot.cycle != cycle_;
  slot.cycle = cycle_;
  contact.error_bound = std::max(contact.error_bound, pair.error.total());
  contact.contact_error = std::max(contact.contact_error, pair.contact_error.total());
  const double proved = pair.deepest.time;
  contact.seen_at_samples |= holdsSample(isTimed(pair) ? interval : Interval{proved, proved}, cycle.samples);
  const double force = forceWhileTouching(cycle, pair);
  // What is not known in a cycle stays not known.
  if (!std::isnan(contact.max_force) && !(force <= contact.max_force)) contact.max_force = force;
  // If no interval has a proving point, as when surfaces are known to cross, each may be the contact.
  const auto isProvedWithin = [&](const Interval& other) { return isProved(pair, other); };
  const bool is_contact =
      pair.verdict == Verdict::kContact &&
      (isProved(pair, interval) || std::none_of(pair.intervals.begin(), pair.intervals.end(), isProvedWithin));
  if (is_contact) contact.verdict = Verdict::kContact;
  const ContactPoint* deepest = deepestWithin(pair, interval);
  // Points of a contact that may be none, as inside an open mesh, give way to those of a certain one.
  const bool is_better = deepest && (!slot.has_deepest || is_contact > slot.deepest_is_certain ||
                                     (is_contact == slot.deepest_is_certain && isDeeper(*deepest, contact.deepest)));
  if (is_better) {
    contact.deepest = *deepest;
    // Of a contact that goes on over a swap the bodies may be in the other order now.
    if (groups_.keys[group].first.compare(1, std::string::npos, contact.body_a) != 0)
      contact.deepest.normal_W = -deepest->normal_W;
    contact.deepest_origin = cycle.origin;
    if (is_contact > slot.deepest_is_certain) slot.max_depth = 0.0;
    slot.has_deepest = true;
    slot.deepest_is_certain = is_contact;
  }
  // Points of other cycles may be deeper by their own errors. If measured, the deepest one stands for all of its
  // contact.
  const bool is_measured = pair.measured && deepest == &pair.deepest;
  if (deepest && is_contact == slot.deepest_is_certain && (deepest->depth > 0.0 || is_measured))
    slot.max_depth = std::max(slot.max_depth, deepest->depth + deepest->depth_error);
  contact.deepest.depth_error = std::max(contact.deepest.depth_error, slot.max_depth - contact.deepest.depth);
}

/// Ends the contact as lost if a pair of its group is not checked and none was seen to touch in this cycle.
void ContactTracker::Impl::closeIfOver(const ObservedCycle& cycle, Slot& slot) {
  const auto group = static_cast<std::size_t>(slot.group);
  bool is_delayed = false;
  bool is_apart = true;      // at that time, farther than a break of a contact allows
  Time until = Time::max();  // time up to which all pairs of the group are checked
  for (int i = groups_.begin[group]; i < groups_.begin[group + 1]; ++i) {
    const PairResult& pair = cycle.result.pairs[groups_.pairs[i]];
    if (pair.span.empty()) {
      is_delayed = true;
    } else if ((pair.verdict == Verdict::kNotChecked || pair.postponed) && slot.cycle != cycle_) {
      return close(slot, true);
    } else {
      until = std::min(until, cycle.origin + toTime(cycle.motion.times[pair.span.last]));
      is_apart &= pair.verdict == Verdict::kClear && pair.clearance > join_.distance;
    }
  }
  if (is_delayed) return;
  slot.was_apart |= is_apart && slot.contact.end < until;
  if (slot.contact.end + longestBreak(slot) < until) close(slot, false);
}

/// The contact of the times from `start` to `end`: the group's last one if they meet, otherwise a new one. It has ended
/// if it lies before the last one.
ContactTracker::Impl::Slot& ContactTracker::Impl::slotFor(std::size_t group, Time start, Time end) {
  const bool is_earlier = last_[group] >= 0 && end + join_.time < slots_[last_[group]].contact.begin;
  if (last_[group] >= 0 && !is_earlier) {
    Slot& last = slots_[last_[group]];
    if (start <= last.contact.end + longestBreak(last) && !last.contact.is_lost) {
      last.was_apart = false;
      if (!last.is_open) {
        last.is_open = true;
        last.contact.ends = false;
        ++open_;
      }
      list(last_[group]);
      return last;
    }
    if (last.is_open) close(last, false);
    if (!last.is_listed) free_.push_back(last_[group]);
  }
  if (is_earlier)
    if (Slot* const ended = endedEarlier(group, start, end)) return *ended;
  const int index = freeSlot(start);
  if (!is_earlier) last_[group] = index;
  Slot& slot = slots_[index];
  TrackedContact& contact = slot.contact;
  const auto& [key_a, key_b] = groups_.keys[group];
  contact.body_a.assign(key_a, 1);
  contact.body_b.assign(key_b, 1);
  contact.id = next_id_++;
  contact.begins = true;
  contact.ends = contact.is_lost = contact.seen_at_samples = false;
  contact.verdict = Verdict::kUncertain;
  contact.begin = start;
  contact.end = end;
  contact.deepest = {};
  contact.deepest_origin = {};
  contact.error_bound = contact.contact_error = contact.max_force = 0.0;
  contact.cycles = 0;
  slot.group = static_cast<int>(group);
  slot.has_deepest = slot.deepest_is_certain = slot.was_apart = false;
  slot.max_depth = 0.0;
  slot.is_open = true;
  slot.cycle = 0;
  ++open_;
  list(index);
  if (is_earlier) close(slot, false);
  return slot;
}

/// A contact that ended before the group's last one began, and that the times from `start` to `end` meet: they have
/// been checked again. It is listed once more. Null if there is none.
ContactTracker::Impl::Slot* ContactTracker::Impl::endedEarlier(std::size_t group, Time start, Time end) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    const TrackedContact& contact = slot.contact;
    const bool meets = start <= contact.end + join_.time && contact.begin <= end + join_.time;
    if (slot.group != static_cast<int>(group) || slot.is_open || contact.is_lost || !meets) continue;
    const int index = static_cast<int>(i);
    free_.erase(std::remove(free_.begin(), free_.end(), index), free_.end());
    slot.contact.ends = true;
    list(index);
    return &slot;
  }
  return nullptr;
}

/// A slot whose contact ended so long ago that no cycle goes back to it.
int ContactTracker::Impl::freeSlot(Time start) {
  constexpr Time kRemembered = std::chrono::seconds(2);
  const auto found = std::find_if(free_.begin(), free_.end(), [&](int index) {
    return slots_[index].group < 0 || slots_[index].contact.end + kRemembered < start;
  });
  if (found != free_.end()) {
    const int index = *found;
    free_.erase(found);
    return index;
  }
  slots_.emplace_back();
  free_.reserve(slots_.capacity());
  unreported_.reserve(slots_.capacity());
  return static_cast<int>(slots_.size()) - 1;
}

void ContactTracker::Impl::close(Slot& slot, bool is_lost) {
  slot.is_open = false;
  slot.contact.ends = true;
  slot.contact.is_lost = is_lost;
  --open_;
}

void ContactTracker::Impl::list(int index) {
  if (slots_[index].is_listed) return;
  slots_[index].is_listed = true;
  listed_.push_back(index);
}

}  // namespace sdf_ccd
