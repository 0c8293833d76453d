#pragma once

#include <string>

namespace sdf_ccd {

/// What fetching one file over the network may take.
struct FetchLimits {
  double seconds = 30.0;
  std::size_t bytes = std::size_t{256} << 20;
};

/// The content behind an http:// or https:// URI, by the program sdf_ccd_fetch: a process that can be left at any
/// moment.
/// @throws std::runtime_error with the reason; Cancelled, within 20 ms of a CancelScope's asking for it.
std::string fetchHttp(const std::string& uri, const FetchLimits& limits = {});

}  // namespace sdf_ccd
