#pragma once

#include <set>
#include <string>

namespace sdf_ccd {

/// A suggestion for a misspelt name: of the known names the one with the smallest edit distance (letters inserted,
/// left out, replaced or swapped with their neighbour). Upper and lower case are the same.
/// @return empty if none is similar: if more than half of its letters, and more than two, differ.
std::string nearestName(const std::string& name, const std::set<std::string>& known);

/// For errors about a name that is not known: ", did you mean xyz?", or, if none is similar, ", known names: a, b and
/// c".
std::string suggestion(const std::string& name, const std::set<std::string>& known);

}  // namespace sdf_ccd
