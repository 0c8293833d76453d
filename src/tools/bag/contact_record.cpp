#include "contact_record.h"

#include <algorithm>
#include <cstdio>

#include "cycle_record.h"

namespace sdf_ccd::tools {
namespace {

const ros::Duration kJoin(0.001);  // shorter breaks are of rounding, or of a field's cells

/// The deepest point that the message names within the interval; null if it names none.
const PointContact* deepestWithin(const PairContact& pair, const TimeInterval& interval) {
  const auto isWithin = [&](const PointContact& p) { return interval.start <= p.time && p.time <= interval.end; };
  if (isWithin(pair.deepest)) return &pair.deepest;
  const auto found = std::find_if(pair.points.begin(), pair.points.end(), isWithin);
  return found == pair.points.end() ? nullptr : &*found;
}

}  // namespace

void ContactJoiner::add(const ContactArray& message) {
  if (message.cycle_start < until_) last_.clear();  // time has jumped back: nothing goes on
  until_ = message.header.stamp;
  for (const PairContact& pair : message.pairs) {
    bool is_first = true;
    for (const TimeInterval& interval : pair.intervals) {
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
      const PointContact* deepest = deepestWithin(pair, interval);
      if (!deepest || deepest->depth < contact.deepest.depth) continue;
      contact.deepest = *deepest;
      // As the pair's verdict is found: a point that is deeper than the bound without the gap between points.
      if (deepest->depth > pair.error_bound - pair.error_gap) contact.verdict = Verdict::kContact;
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
  char bounds[80], point[160];
  std::snprintf(bounds, sizeof bounds, ",%.6g,%.6g,%.6g,", r.deepest.depth, r.deepest.depth_error, r.error_bound);
  std::snprintf(point, sizeof point, ",%.9g,%.9g,%.9g,%.6g,%.6g,%.6g,%u,%d\n", p.x, p.y, p.z, n.x, n.y, n.z, r.cycles,
                int(r.seen_at_samples));
  return csvText(r.body_a) + "," + csvText(r.body_b) + "," + toString(r.verdict) + "," + timeText(r.start) + "," +
         timeText(r.end) + bounds + timeText(r.deepest.time) + point;
}

}  // namespace sdf_ccd::tools
