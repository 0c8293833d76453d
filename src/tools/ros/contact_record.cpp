#include "contact_record.h"

#include <algorithm>

#include <fmt/format.h>

#include "cycle_record.h"

namespace sdf_ccd::tools {
namespace {

const ros::Duration kJoin(0.001);  // shorter breaks are of rounding, or of a field's cells

bool isWithin(const PointContact& point, const TimeInterval& interval) {
  return interval.start <= point.time && point.time <= interval.end;
}

/// The deepest point that the message names within the interval; null if it names none.
const PointContact* deepestWithin(const PairContact& pair, const TimeInterval& interval) {
  if (isWithin(pair.deepest, interval)) return &pair.deepest;
  const auto found = std::find_if(pair.points.begin(), pair.points.end(),
                                  [&](const PointContact& point) { return isWithin(point, interval); });
  return found == pair.points.end() ? nullptr : &*found;
}

ErrorBound errorOf(const PairContact& pair) {
  return {pair.error_field, pair.error_chord, pair.error_root, pair.error_gap};
}

/// Which of a pair's intervals its verdict is about: those with a point that proves contact, as the monitor takes it.
/// Where no point that the message lists does, as where surfaces are known to cross, it may be any of them.
std::vector<bool> inContact(const PairContact& pair) {
  if (pair.verdict != PairContact::CONTACT) return std::vector<bool>(pair.intervals.size(), false);
  std::vector<bool> proved;
  for (const TimeInterval& interval : pair.intervals) {
    const auto proves = [&](const PointContact& p) {
      return isWithin(p, interval) && errorOf(pair).provesContact(p.depth, p.depth_error);
    };
    proved.push_back(proves(pair.deepest) || std::any_of(pair.points.begin(), pair.points.end(), proves));
  }
  const bool any = std::find(proved.begin(), proved.end(), true) != proved.end();
  return any ? proved : std::vector<bool>(proved.size(), true);
}

}  // namespace

void ContactJoiner::add(const ContactArray& message) {
  if (message.cycle_start < until_) last_.clear();  // time has jumped back: nothing goes on
  until_ = message.header.stamp;
  for (const PairContact& pair : message.pairs) {
    bool is_first = true;
    const std::vector<bool> in_contact = inContact(pair);
    for (std::size_t i = 0; i < pair.intervals.size(); ++i) {
      const TimeInterval& interval = pair.intervals[i];
      const auto [known, is_new] = last_.try_emplace({pair.body_a, pair.body_b}, contacts_.size());
      if (is_new || interval.start > contacts_[known->second].end + kJoin) {
        known->second = contacts_.size();
        contacts_.emplace_back();
        contacts_.back().body_a = pair.body_a;
        contacts_.back().body_b = pair.body_b;
        contacts_.back().start = interval.start;
        is_first = true;
      }
      ContactRecord& contact = contacts_[known->second];
      contact.end = std::max(contact.end, interval.end);
      contact.cycles += is_first;
      is_first = false;
      contact.error_bound = std::max(contact.error_bound, pair.error_bound);
      contact.seen_at_samples |= bool(pair.in_contact_at_samples);
      if (in_contact[i]) contact.verdict = Verdict::kContact;
      const PointContact* deepest = deepestWithin(pair, interval);
      if (deepest && deepest->depth >= contact.deepest.depth) contact.deepest = *deepest;
    }
  }
}

std::vector<ContactRecord> ContactJoiner::contacts() const {
  std::vector<ContactRecord> sorted = contacts_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const ContactRecord& a, const ContactRecord& b) { return a.start < b.start; });
  return sorted;
}

std::string contactColumns() {
  return "body_a,body_b,verdict,start,end,depth,depth_error,error_bound,deepest_at,x,y,z,nx,ny,nz,cycles,seen_at_"
         "samples\n";
}

std::string toRow(const ContactRecord& r) {
  const geometry_msgs::Point& p = r.deepest.position;
  const geometry_msgs::Vector3& n = r.deepest.normal;
  return fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g},{},{:d}\n",
                     csvText(r.body_a), csvText(r.body_b), toString(r.verdict), timeText(r.start), timeText(r.end),
                     r.deepest.depth, r.deepest.depth_error, r.error_bound, timeText(r.deepest.time), p.x, p.y, p.z,
                     n.x, n.y, n.z, r.cycles, r.seen_at_samples);
}

}  // namespace sdf_ccd::tools
