#include "monitor/contact_tracker.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

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

/// Whether a listed point proves that the pair touches within the interval.
bool isProved(const PairResult& pair, const Interval& interval) {
  return proves(pair, pair.deepest, interval) ||
         std::any_of(pair.points.begin(), pair.points.end(),
                     [&](const ContactPoint& point) { return proves(pair, point, interval); });
}

/// The deepest listed point within the interval; null if none is listed.
const ContactPoint* deepestWithin(const PairResult& pair, const Interval& interval) {
  if (isWithin(pair.deepest, interval)) return &pair.deepest;
  const auto found = std::find_if(pair.points.begin(), pair.points.end(),
                                  [&](const ContactPoint& point) { return isWithin(point, interval); });
  return found == pair.points.end() ? nullptr : &*found;
}

/// Mean force while the pair touched [N]; results hold the mean over the whole span.
double forceWhileTouching(const ObservedCycle& cycle, const PairResult& pair) {
  double touching = 0.0;
  for (const Interval& interval : pair.intervals) touching += interval.exit - interval.enter;
  const double length = cycle.motion.times[pair.span.last] - cycle.motion.times[pair.span.first];
  return touching > 0.0 ? pair.on_a_W.force.norm() * length / touching : 0.0;
}

/// Identity of a body, or of the map that it is a tile of: the name after a letter that tells the two apart, because a
/// body and a map may share a name.
std::string keyOf(const Body& body) {
  return body.map.empty() ? "b" + body.name : "m" + body.map;
}

ContactTracker::Groups groupsOf(const Scene& scene) {
  const std::size_t count = scene.pairs.size();
  ContactTracker::Groups groups;
  groups.of_pair.reserve(count);
  std::vector<std::string> key_of_body;
  key_of_body.reserve(scene.bodies.size());
  for (const Body& body : scene.bodies) key_of_body.push_back(keyOf(body));
  std::map<std::pair<std::string_view, std::string_view>, int> of_maps;
  for (const PlannedPair& pair : scene.pairs) {
    const auto a = static_cast<std::size_t>(pair.body_a), b = static_cast<std::size_t>(pair.body_b);
    const auto next = static_cast<int>(groups.keys.size());
    const bool has_tile = !scene.bodies[a].map.empty() || !scene.bodies[b].map.empty();
    const int group = has_tile ? of_maps.try_emplace({key_of_body[a], key_of_body[b]}, next).first->second : next;
    if (group == next) groups.keys.emplace_back(key_of_body[a], key_of_body[b]);
    groups.of_pair.push_back(group);
  }
  groups.begin.assign(groups.keys.size() + 1, 0);
  for (const int group : groups.of_pair) ++groups.begin[static_cast<std::size_t>(group) + 1];
  for (std::size_t g = 1; g < groups.begin.size(); ++g) groups.begin[g] += groups.begin[g - 1];
  groups.pairs.resize(count);
  std::vector<int> filled(groups.begin.begin(), groups.begin.end() - 1);
  for (std::size_t p = 0; p < count; ++p)
    groups.pairs[static_cast<std::size_t>(filled[static_cast<std::size_t>(groups.of_pair[p])]++)] = static_cast<int>(p);
  return groups;
}

}  // namespace

bool holdsSample(const Interval& interval, const std::vector<double>& samples) {
  const auto first = std::lower_bound(samples.begin(), samples.end(), interval.enter);
  return first != samples.end() && *first <= interval.exit;
}

ContactTracker::Change ContactTracker::prepare(const Scene& next) const {
  Change change;
  change.groups = groupsOf(next);
  change.groups_now = findPairs(groups_.keys, change.groups.keys);
  change.last.assign(change.groups.keys.size(), -1);
  // At most one contact per group, and those that end with the present groups.
  change.listed.reserve(change.groups.keys.size() + 2 * groups_.keys.size());
  return change;
}

void ContactTracker::adopt(const Scene& scene) {
  Change change = prepare(scene);
  adopt(change);
}

void ContactTracker::adopt(Change& change) {
  change.listed.assign(listed_.begin(), listed_.end());
  listed_.swap(change.listed);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Slot& contact = contacts_[i];
    if (contact.group < 0) continue;
    const auto group = static_cast<std::size_t>(contact.group);
    const bool is_last = last_[group] == static_cast<int>(i);
    contact.group = is_last ? change.groups_now[group] : -1;
    if (!is_last) continue;
    if (contact.group >= 0) {
      change.last[static_cast<std::size_t>(contact.group)] = static_cast<int>(i);
      continue;
    }
    // The next world does not have the pair.
    if (contact.is_open) {
      close(contact, true);
      list(static_cast<int>(i));
      contact.is_unreported = true;
    }
    if (!contact.is_listed) free_.push_back(static_cast<int>(i));
  }
  std::swap(groups_, change.groups);
  last_.swap(change.last);
}

void ContactTracker::settle() {
  for (const int slot : listed_) {
    Slot& contact = contacts_[slot];
    contact.said.begins = false;
    if (contact.is_unreported) {
      unreported_.push_back(slot);
      continue;
    }
    contact.said.ends = false;
    contact.is_listed = contact.is_open;
    if (!contact.is_open && (contact.group < 0 || last_[contact.group] != slot)) free_.push_back(slot);
  }
  const auto isOver = [&](int slot) { return !contacts_[slot].is_listed || contacts_[slot].is_unreported; };
  listed_.erase(std::remove_if(listed_.begin(), listed_.end(), isOver), listed_.end());
}

void ContactTracker::reportPending() {
  for (const int slot : unreported_) contacts_[slot].is_unreported = false;
  listed_.insert(listed_.end(), unreported_.begin(), unreported_.end());
  unreported_.clear();
}

void ContactTracker::lose() {
  reportPending();
  for (const int slot : listed_) {
    if (contacts_[slot].is_open) close(contacts_[slot], true);
  }
  // Later contacts do not join these.
  std::fill(last_.begin(), last_.end(), -1);
  for (const int slot : listed_) {
    contacts_[slot].group = -1;
    contacts_[slot].is_unreported = false;
  }
  free_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!contacts_[i].is_listed) free_.push_back(static_cast<int>(i));
  }
}

void ContactTracker::update(const ObservedCycle& cycle) {
  settle();
  reportPending();
  ++cycle_;
  touches_.clear();
  if (cycle.result.verdict != Verdict::kClear) {
    for (std::size_t i = 0; i < groups_.of_pair.size(); ++i) {
      const PairResult& pair = cycle.result.pairs[i];
      if (pair.span.empty()) continue;
      for (std::size_t k = 0; k < pair.intervals.size(); ++k)
        touches_.push_back({groups_.of_pair[i], pair.intervals[k].enter, static_cast<int>(i), static_cast<int>(k)});
    }
    std::sort(touches_.begin(), touches_.end(), [](const TouchInterval& a, const TouchInterval& b) {
      return std::tie(a.group, a.enter, a.pair, a.interval) < std::tie(b.group, b.enter, b.pair, b.interval);
    });
  }
  const auto timeOf = [&](double t) { return cycle.origin + toTime(t); };
  for (auto first = touches_.begin(); first != touches_.end();) {
    // The intervals that meet are of one contact.
    Time end = timeOf(exitOf(cycle.result, *first));
    auto last = first + 1;
    for (; last != touches_.end() && last->group == first->group && timeOf(last->enter) <= end + kJoin; ++last)
      end = std::max(end, timeOf(exitOf(cycle.result, *last)));
    Slot& slot = slotFor(static_cast<std::size_t>(first->group), timeOf(first->enter), end);
    for (; first != last; ++first) addTouch(cycle, *first, slot);
  }
  if (open_ == 0) return;
  for (const int slot : listed_) {
    if (contacts_[slot].is_open) closeIfOver(cycle, contacts_[slot]);
  }
}

double ContactTracker::exitOf(const CycleResult& result, const TouchInterval& touch) {
  return result.pairs[touch.pair].intervals[touch.interval].exit;
}

void ContactTracker::addTouch(const ObservedCycle& cycle, const TouchInterval& stay, Slot& slot) {
  const PairResult& pair = cycle.result.pairs[stay.pair];
  const Interval& interval = pair.intervals[stay.interval];
  const Time start = cycle.origin + toTime(interval.enter), end = cycle.origin + toTime(interval.exit);
  const auto group = static_cast<std::size_t>(stay.group);
  TrackedContact& contact = slot.said;
  contact.begin = std::min(contact.begin, start);
  contact.end = std::max(contact.end, end);
  contact.cycles += slot.cycle != cycle_;
  slot.cycle = cycle_;
  contact.error_bound = std::max(contact.error_bound, pair.error.total());
  contact.contact_error = std::max(contact.contact_error, pair.contact_error.total());
  contact.seen_at_samples |= holdsSample(interval, cycle.samples);
  contact.max_force = std::max(contact.max_force, forceWhileTouching(cycle, pair));
  // If no interval has a proving point, as when surfaces are known to cross, each may be the contact.
  const auto isProvedWithin = [&](const Interval& other) { return isProved(pair, other); };
  const bool is_contact =
      pair.verdict == Verdict::kContact &&
      (isProved(pair, interval) || std::none_of(pair.intervals.begin(), pair.intervals.end(), isProvedWithin));
  if (is_contact) contact.verdict = Verdict::kContact;
  const ContactPoint* deepest = deepestWithin(pair, interval);
  if (deepest && (!slot.has_deepest || deepest->depth > contact.deepest.depth)) {
    contact.deepest = *deepest;
    // Of a contact that goes on over a swap the bodies may be in the other order now.
    if (groups_.keys[group].first.compare(1, std::string::npos, contact.body_a) != 0)
      contact.deepest.normal_W = -deepest->normal_W;
    contact.deepest_origin = cycle.origin;
    slot.has_deepest = true;
  }
  if (pair.refined) slot.reach = std::max(slot.reach, pair.deepest.depth + pair.deepest.depth_error);
  contact.deepest.depth_error = std::max(contact.deepest.depth_error, slot.reach - contact.deepest.depth);
}

/// Ends the contact as lost if a pair of its group is not checked and none was seen to touch in this cycle.
void ContactTracker::closeIfOver(const ObservedCycle& cycle, Slot& slot) {
  const auto group = static_cast<std::size_t>(slot.group);
  bool is_delayed = false;
  Time until = Time::max();  // time up to which all pairs of the group are checked
  for (int i = groups_.begin[group]; i < groups_.begin[group + 1]; ++i) {
    const PairResult& pair = cycle.result.pairs[groups_.pairs[i]];
    if (pair.span.empty()) {
      is_delayed = true;
    } else if ((pair.verdict == Verdict::kNotChecked || pair.postponed) && slot.cycle != cycle_) {
      return close(slot, true);
    } else {
      until = std::min(until, cycle.origin + toTime(cycle.motion.times[pair.span.last]));
    }
  }
  if (!is_delayed && slot.said.end + kJoin < until) close(slot, false);
}

/// The contact of the times from `start` to `end`: the group's last one if they meet, otherwise a new one. It has ended
/// if it lies before the last one.
ContactTracker::Slot& ContactTracker::slotFor(std::size_t group, Time start, Time end) {
  const bool is_earlier = last_[group] >= 0 && end + kJoin < contacts_[last_[group]].said.begin;
  if (last_[group] >= 0 && !is_earlier) {
    Slot& last = contacts_[last_[group]];
    if (start <= last.said.end + kJoin && !last.said.is_lost) {
      if (!last.is_open) {
        last.is_open = true;
        last.said.ends = false;
        ++open_;
      }
      list(last_[group]);
      return last;
    }
    if (last.is_open) close(last, false);
    if (!last.is_listed) free_.push_back(last_[group]);
  }
  if (free_.empty()) {
    free_.push_back(static_cast<int>(contacts_.size()));
    contacts_.emplace_back();
    free_.reserve(contacts_.capacity());
    unreported_.reserve(contacts_.capacity());
  }
  const int index = free_.back();
  free_.pop_back();
  if (!is_earlier) last_[group] = index;
  Slot& slot = contacts_[index];
  TrackedContact& said = slot.said;
  const auto& [key_a, key_b] = groups_.keys[group];
  said.body_a.assign(key_a, 1);
  said.body_b.assign(key_b, 1);
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
  slot.group = static_cast<int>(group);
  slot.has_deepest = false;
  slot.reach = 0.0;
  slot.is_open = true;
  slot.cycle = 0;
  ++open_;
  list(index);
  if (is_earlier) close(slot, false);
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
