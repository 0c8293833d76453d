#include "contact_record.h"

#include <algorithm>

#include <fmt/format.h>

#include "cycle_record.h"
#include "sdf_ccd/result.h"

namespace sdf_ccd::tools {

void ContactRecords::add(const ContactArray& message) {
  for (const Contact& contact : message.contacts) {
    if (contact.begins) known_.erase(contact.id);  // the monitor was started again
    const auto [known, is_new] = known_.try_emplace(contact.id, contacts_.size());
    if (is_new) {
      contacts_.push_back(contact);
    } else {
      contacts_[known->second] = contact;
    }
  }
}

std::vector<Contact> ContactRecords::contacts() const {
  std::vector<Contact> sorted = contacts_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Contact& a, const Contact& b) { return a.begin < b.begin; });
  return sorted;
}

std::string contactColumns() {
  return "id,body_a,body_b,verdict,start,end,depth,depth_error,error_bound,contact_error_bound,deepest_at,x,y,z,nx,ny,"
         "nz,max_force,cycles,seen_at_samples,is_lost\n";
}

std::string toRow(const Contact& c) {
  const geometry_msgs::Point& p = c.deepest.position;
  const geometry_msgs::Vector3& n = c.deepest.normal;
  return fmt::format(
      "{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g},{:.6g},{},{:d},{:d}"
      "\n",
      c.id, csvText(c.body_a), csvText(c.body_b), toString(static_cast<Verdict>(c.verdict)), timeText(c.begin),
      timeText(c.end), c.deepest.depth, c.deepest.depth_error, c.error_bound, c.contact_error_bound,
      timeText(c.deepest.time), p.x, p.y, p.z, n.x, n.y, n.z, c.max_force, c.cycles, bool(c.seen_at_samples),
      bool(c.is_lost));
}

}  // namespace sdf_ccd::tools
