#include "ros/messages/contact_states.h"

#include <fmt/format.h>

#include "ros/messages/conversions.h"

namespace sdf_ccd {
namespace {

geometry_msgs::Vector3 opposite(geometry_msgs::Vector3 vector) {
  vector.x = -vector.x;
  vector.y = -vector.y;
  vector.z = -vector.z;
  return vector;
}

gazebo_msgs::ContactState toContactState(const PairContact& pair) {
  gazebo_msgs::ContactState state;
  state.info = pair.verdict == numberOf(Verdict::kContact) ? "CONTACT" : "UNCERTAIN";
  state.collision1_name = pair.body_a;
  state.collision2_name = pair.body_b;
  state.total_wrench = pair.wrench_on_a;
  if (pair.intervals.empty()) return state;
  state.info += fmt::format(" from {:.6f} s, depth {:.3g} m, error bound {:.3g} m", pair.first_contact.toSec(),
                            pair.deepest.depth, pair.deepest.depth_error);
  state.wrenches.push_back(pair.wrench_on_a);
  state.contact_positions.push_back(toVector3(toEigen(pair.deepest.position)));
  state.contact_normals.push_back(opposite(pair.deepest.normal));
  state.depths.push_back(pair.deepest.depth);
  return state;
}

}  // namespace

gazebo_msgs::ContactsState toContactStates(const ContactArray& contacts) {
  gazebo_msgs::ContactsState message;
  message.header = contacts.header;
  for (const PairContact& pair : contacts.pairs) {
    const bool is_found = pair.verdict == numberOf(Verdict::kUncertain) && !pair.intervals.empty();
    if (pair.verdict == numberOf(Verdict::kContact) || is_found) message.states.push_back(toContactState(pair));
  }
  return message;
}

}  // namespace sdf_ccd
