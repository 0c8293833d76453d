#pragma once

#include <stdexcept>
#include <string>

#include "common/number_text.h"

namespace sdf_ccd {

/// Makes something to a fineness [m], or to twice, four times, ... of it where it would be too large.
/// @param make      called with the fineness; throws std::length_error where that is too fine.
/// @param may       false: what make() throws passes through.
/// @param warning   gets why it is coarser, if it is.
template <typename Make>
auto makeCoarser(double fineness, bool may, const Make& make, std::string& warning) {
  for (double tried = fineness;; tried *= 2.0) {
    try {
      return make(tried);
    } catch (const std::length_error& error) {
      if (!may || tried > 1e3 * fineness) throw;
      if (warning.empty()) warning = error.what();
      warning += "; " + numberText(2.0 * tried) + " m instead";
    }
  }
}

}  // namespace sdf_ccd
