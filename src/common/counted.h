#pragma once

#include <string>

namespace sdf_ccd {

/// "1 pair", "2 pairs". @param noun  in the singular, with a regular plural.
inline std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// The first texts of a list, and how many are left out: "a, b and 3 more".
/// @param last  between the texts and the number of the others.
template <class Texts>
std::string firstOf(const Texts& texts, std::size_t most, const std::string& separator = ", ",
                    const std::string& last = " and ") {
  std::string list;
  std::size_t count = 0;
  for (const std::string& text : texts)
    if (count++ < most) list += (count == 1 ? "" : separator) + text;
  return count > most ? list + last + std::to_string(count - most) + " more" : list;
}

}  // namespace sdf_ccd
