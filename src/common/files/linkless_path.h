#pragma once

#include <fcntl.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "common/files/descriptor.h"

namespace sdf_ccd {

/// Opens a path no component of which may be a symbolic link, such as one whose links have been resolved: a link that
/// somebody puts in the place of a folder meanwhile is refused, not followed.
/// @param path   absolute, without `..`.
/// @param flags  as for ::open(); O_NOFOLLOW and O_CLOEXEC are added.
/// @throws std::system_error if a component is a link, or it cannot be opened; std::invalid_argument for other paths.
inline Descriptor openWithoutLinks(const std::filesystem::path& path, int flags) {
  if (!path.is_absolute() || path != path.lexically_normal())
    throw std::invalid_argument(path.string() + ": not an absolute path without . and ..");
  constexpr int kStep = O_PATH | O_DIRECTORY;
  Descriptor at(::open("/", kStep | O_CLOEXEC));
  // One component at a time, as O_NOFOLLOW counts for the last one only.
  const std::filesystem::path components = path.relative_path();
  for (auto component = components.begin(); at.isOpen() && component != components.end(); ++component) {
    const bool is_last = std::next(component) == components.end();
    at = Descriptor(::openat(at.number(), component->c_str(), (is_last ? flags : kStep) | O_NOFOLLOW | O_CLOEXEC));
  }
  if (!at.isOpen()) throw std::system_error(errno, std::generic_category());
  return at;
}

}  // namespace sdf_ccd
