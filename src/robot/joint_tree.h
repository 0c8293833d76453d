#pragma once

#include <string>
#include <vector>

#include <tinyxml2.h>

namespace sdf_ccd {

/// Changes the joints and the names of a URDF's links so that urdfdom reads all of them, and they are a tree: what is
/// wrong with one joint or link costs no other.
///  - A joint that cannot be read, or whose axis is 0 0 0, becomes a floating one: its child is where tf has it, and
///    nothing follows from the joint. So does that of a link that is the child of two joints.
///  - A joint that mimics a missing joint, itself, or a hundred others in turn, becomes one of its own.
///  - A joint between links that do not exist goes; links that no joint leads to from the root, also those in a loop,
///    float below it. The root is the one with most links below it.
/// What a joint says besides (calibration, dynamics, safety limits; efforts) is not read, and cannot be wrong.
/// @param warnings  gets a line for each of these, at most twenty.
void makeTree(tinyxml2::XMLElement& robot, std::vector<std::string>& warnings);

}  // namespace sdf_ccd
