#pragma once

#include <cstddef>
#include <string>

namespace sdf_ccd {

/// Makes the directory, for its owner alone, if it does not exist.
/// @throws std::runtime_error if it cannot be made, belongs to another user than root, or others may write to it: their
/// files would be trusted.
void requireOwnDirectory(const std::string& directory);

/// @throws std::runtime_error if the file is a link or no regular file, belongs to another user than root, or others
/// may write to it.
void requireOwnFile(const std::string& path);

/// Marks a file of the cache as used now.
void markUsed(const std::string& path);

/// Removes the least recently used files until the cache's files hold no more than `max_bytes`, except for files of
/// `name`; and temporary files that a process left an hour ago or earlier. Other files are left alone.
void trimCache(const std::string& directory, const std::string& name, std::size_t max_bytes);

}  // namespace sdf_ccd
