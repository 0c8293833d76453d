#pragma once

#include <cstddef>
#include <string>

namespace sdf_ccd {

/// Upper bound of the size of meshes, maps and other files that are read whole: 1 GiB.
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;

/// The content of a file on disk. Devices, pipes and sockets, whose reading might never end, are not opened.
/// @throws std::runtime_error with the reason, without the path; Cancelled.
std::string readRegularFile(const std::string& path, std::size_t max_bytes = kMaxFileBytes);

/// The same; what it throws begins with the path.
std::string readNamedFile(const std::string& path, std::size_t max_bytes = kMaxFileBytes);

/// The same, without the path in errors, for a path no component of which may be a symbolic link (see
/// openWithoutLinks()).
std::string readWithoutLinks(const std::string& path, std::size_t max_bytes = kMaxFileBytes);

}  // namespace sdf_ccd
