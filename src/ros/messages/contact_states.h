#pragma once

#include "ros/messages/contacts_state_message.h"
#include "sdf_ccd/ContactArray.h"

namespace sdf_ccd {

/// Contacts of a cycle, for programs that read Gazebo's contact sensors. There is one state per pair that is CONTACT,
/// or UNCERTAIN if a contact was found; `info` begins with the verdict. Collision 1 is body A. A state holds only the
/// pair's deepest point, in the axes of the cycle's fixed frame: its position when it was deepest, the normal towards
/// body A, and the wrench on body A about the origin of its frame, averaged over the checked time [m, N, N·m]. A pair
/// whose contact was proved by its triangles but not located has no point.
///
/// The message cannot tell what was not checked: a missing state does not mean that a pair is apart.
gazebo_msgs::ContactsState toContactStates(const ContactArray& contacts);

}  // namespace sdf_ccd
