#include "monitor/contact_tracker.h"

#include <algorithm>
#include <cmath>

#include "scene_difference.h"

namespace sdf_ccd {
namespace {

using Time = std::chrono::nanoseconds;

Time toTime(double seconds) {
  return Time(std::llround(1e9 * seconds));
}

bool isWithin(const ContactPoint& point, const Interval& interval) {
  return interval.enter <= point.time && point.time <= interval.exit;
}

bool proves(const PairResult& pair, const ContactPoint& point, const Interval& interval) {
  return isWithin(point, interval) && pair.contact_error.provesContact(point.depth, point.depth_error);
}

/// Whether some point that the result lists proves that the pair touches within the interval.
bool isProved(const PairResult& pair, const Interval& interval) {
  return proves(pair, pair.deepest, interval) ||
         std::any_of(pair.points.begin(), pair.points.end(),
                     [&](const ContactPoint& point) { return proves(pair, point, interval); });
}

/// The deepest point that the result lists within the interval; null if it lists none.
const ContactPoint* deepestWithin(const PairResult& pair, const Interval& interval) {
  if (isWithin(pair.deepest, interval)) return &pair.deepest;
  const auto found = std::find_if(pair.points.begin(), pair.points.end(),
                                  [&](const ContactPoint& point) { return isWithin(point, interval); });
  return found == pair.points.end() ? nullptr : &*found;
}

/// Mean force while the pair touched: results hold the mean over the span [N].
double forceWhileTouching(const ObservedCycle& cycle, const PairResult& pair) {
  double touching = 0.0;
  for (const Interval& interval : pair.intervals) touching += interval.exit - interval.enter;
  const double length = cycle.motion.times[pair.span.last] - cycle.motion.times[pair.span.first];
  return touching > 0.0 ? pair.on_a_W.force.norm() * length / touching : 0.0;
}

}  // namespace

bool holdsSample(const Interval& interval, const std::vector<double>& samples) {
  const auto first = std::lower_bound(samples.begin(), samples.end(), interval.enter);
  return first != samples.end() && *first <= interval.exit;
}

ContactTracker::Change ContactTracker::prepare(const Scene& next) const {
  Change change;
  change.names = pairNames(next);
  change.pairs_now = findPairs(names_, change.names);
  change.last.assign(next.pairs.size(), -1);
  // At most one contact of each pair, and those that end with the pairs until now.
  change.listed.reserve(next.pairs.size() + 2 * names_.size());
  change.looked_at.reserve(next.pairs.size() + 2 * names_.size());
  return change;
}

void ContactTracker::adopt(const Scene& scene) {
  Change change = prepare(scene);
  adopt(change);
}

void ContactTracker::adopt(Change& change) {
  change.listed.assign(listed_.begin(), listed_.end());
  listed_.swap(change.listed);
  looked_at_.swap(change.looked_at);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Slot& contact = contacts_[i];
    if (contact.pair < 0) continue;
    const auto pair = static_cast<std::size_t>(contact.pair);
    const bool is_last = last_[pair] == static_cast<int>(i);
    contact.pair = is_last ? change.pairs_now[pair] : -1;
    if (!is_last) continue;
    if (contact.pair >= 0) {
      change.last[static_cast<std::size_t>(contact.pair)] = static_cast<int>(i);
      continue;
    }
    // The pair is not checked any more.
    if (contact.is_open) {
      close(contact, true);
      list(static_cast<int>(i));
    }
    if (!contact.is_listed) free_.push_back(static_cast<int>(i));
  }
  names_.swap(change.names);
  last_.swap(change.last);
}

void ContactTracker::settle() {
  for (const int slot : listed_) {
    Slot& contact = contacts_[slot];
    contact.said.begins = contact.said.ends = false;
    contact.is_listed = contact.is_open;
    if (!contact.is_open && (contact.pair < 0 || last_[contact.pair] != slot)) free_.push_back(slot);
  }
  listed_.erase(std::remove_if(listed_.begin(), listed_.end(), [&](int slot) { return !contacts_[slot].is_open; }),
                listed_.end());
}

void ContactTracker::lose() {
  for (const int slot : listed_) {
    if (contacts_[slot].is_open) close(contacts_[slot], true);
  }
  // Nothing that comes joins them.
  std::fill(last_.begin(), last_.end(), -1);
  for (const int slot : listed_) contacts_[slot].pair = -1;
  free_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!contacts_[i].is_listed) free_.push_back(static_cast<int>(i));
  }
}

void ContactTracker::update(const ObservedCycle& cycle) {
  settle();
  ++cycle_;
  if (cycle.result.verdict != Verdict::kClear) {
    for (std::size_t i = 0; i < last_.size(); ++i) updatePair(cycle, i);
    return;
  }
  if (open_ == 0) return;
  looked_at_.assign(listed_.begin(), listed_.end());
  for (const int slot : looked_at_) updatePair(cycle, static_cast<std::size_t>(contacts_[slot].pair));
}

void ContactTracker::updatePair(const ObservedCycle& cycle, std::size_t index) {
  const PairResult& pair = cycle.result.pairs[index];
  const bool was_open = last_[index] >= 0 && contacts_[last_[index]].is_open;
  if ((pair.intervals.empty() && !was_open) || pair.span.empty()) return;

  const bool any_proved = std::any_of(pair.intervals.begin(), pair.intervals.end(),
                                      [&](const Interval& interval) { return isProved(pair, interval); });
  double force = -1.0;
  for (const Interval& interval : pair.intervals) {
    const Time start = cycle.origin + toTime(interval.enter), end = cycle.origin + toTime(interval.exit);
    Slot& slot = slotFor(index, start, end);
    TrackedContact& contact = slot.said;
    contact.begin = std::min(contact.begin, start);
    contact.end = std::max(contact.end, end);
    contact.cycles += slot.cycle != cycle_;
    slot.cycle = cycle_;
    contact.error_bound = std::max(contact.error_bound, pair.error.total());
    contact.contact_error = std::max(contact.contact_error, pair.contact_error.total());
    contact.seen_at_samples |= holdsSample(interval, cycle.samples);
    if (force < 0.0) force = forceWhileTouching(cycle, pair);
    contact.max_force = std::max(contact.max_force, force);
    // Where no point does, as where surfaces are known to cross, it may be any of the intervals.
    const bool is_contact = pair.verdict == Verdict::kContact && (!any_proved || isProved(pair, interval));
    if (is_contact) contact.verdict = Verdict::kContact;
    const ContactPoint* deepest = deepestWithin(pair, interval);
    if (deepest && (contact.cycles == 1 || deepest->depth > contact.deepest.depth)) {
      contact.deepest = *deepest;
      contact.deepest_origin = cycle.origin;
    }
  }
  if (last_[index] < 0) return;
  Slot& slot = contacts_[last_[index]];
  if (!slot.is_open) return;
  const Time until = cycle.origin + toTime(cycle.motion.times[pair.span.last]);
  if (pair.verdict == Verdict::kNotChecked || pair.postponed) {
    close(slot, true);
  } else if (slot.said.end + kJoin < until) {
    close(slot, false);
  }
}

/// The contact that a stay belongs to: the pair's last one, or a new one.
ContactTracker::Slot& ContactTracker::slotFor(std::size_t pair, Time start, Time end) {
  if (last_[pair] >= 0) {
    Slot& last = contacts_[last_[pair]];
    if (start <= last.said.end + kJoin && end + kJoin >= last.said.begin && !last.said.is_lost) {
      if (!last.is_open) {
        last.is_open = true;
        last.said.ends = false;
        ++open_;
      }
      list(last_[pair]);
      return last;
    }
    if (last.is_open) close(last, false);
    if (!last.is_listed) free_.push_back(last_[pair]);
  }
  if (free_.empty()) {
    free_.push_back(static_cast<int>(contacts_.size()));
    contacts_.emplace_back();
    free_.reserve(contacts_.capacity());
  }
  const int index = free_.back();
  free_.pop_back();
  last_[pair] = index;
  Slot& slot = contacts_[index];
  TrackedContact& said = slot.said;
  const auto& [body_a, body_b] = names_[pair];
  said.body_a = body_a;
  said.body_b = body_b;
  said.id = next_id_++;
  said.begins = true;
  said.ends = said.is_lost = said.seen_at_samples = false;
  said.verdict = Verdict::kUncertain;
  said.begin = start;
  said.end = end;
  said.deepest = {};
  said.deepest_origin = {};
  said.error_bound = said.contact_error = said.max_force = 0.0;
  said.cycles = 0;
  slot.pair = static_cast<int>(pair);
  slot.is_open = true;
  slot.cycle = 0;
  ++open_;
  list(index);
  return slot;
}

void ContactTracker::close(Slot& slot, bool is_lost) {
  slot.is_open = false;
  slot.said.ends = true;
  slot.said.is_lost = is_lost;
  --open_;
}

void ContactTracker::list(int slot) {
  if (contacts_[slot].is_listed) return;
  contacts_[slot].is_listed = true;
  listed_.push_back(slot);
}

}  // namespace sdf_ccd
