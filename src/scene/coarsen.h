#pragma once

#include <stdexcept>
#include <string>

#include "common/number_text.h"

namespace sdf_ccd {

/// Builds something with a resolution [m], or with twice, four times, ... of it if the result would be too large.
/// @param make      called with the resolution; throws std::length_error if that is too fine.
/// @param coarsest  how many times coarser it may be: beyond that, exceptions of make() are passed on.
/// @param warning   set to the reason if the result is coarser.
template <typename Make>
auto makeCoarser(double fineness, double coarsest, const Make& make, std::string& warning) {
  for (double tried = fineness;; tried *= 2.0) {
    try {
      return make(tried);
    } catch (const std::length_error& error) {
      if (2.0 * tried > coarsest * fineness) throw;
      if (warning.empty()) warning = error.what();
      warning += "; " + numberText(2.0 * tried) + " m is used instead";
    }
  }
}

}  // namespace sdf_ccd
