#pragma once

#include <string>

namespace sdf_ccd {

/// Limits for fetching one file over the network.
struct FetchLimits {
  double seconds = 30.0;
  std::size_t bytes = std::size_t{256} << 20;
};

/// The content of an http:// or https:// URI, fetched by the program sdf_ccd_fetch in a process that can be stopped at
/// any time.
/// @throws std::runtime_error with the reason; Cancelled within 20 ms after a CancelScope has requested it.
std::string fetchHttp(const std::string& uri, const FetchLimits& limits = {});

}  // namespace sdf_ccd
