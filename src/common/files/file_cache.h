#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace sdf_ccd {

/// How a cached file came to be.
struct CacheOutcome {
  bool from_cache = false;
  bool is_missing = false;  ///< what was made is not in the cache, although it should be
  std::string file;         ///< name in the directory; empty if it is not there
  std::string warning;      ///< a damaged file was made again, or the directory cannot be used; empty if all went well
};

/// Files that are expensive to make, kept in a directory under names made from what they depend on.
///
/// Safe against several processes: the second one waits for the first and loads its file; if that takes too
/// long, as the first has stopped, it makes its own and leaves the cache alone. A file that is damaged, of another
/// version, a link, somebody else's, or one that others may write to is made again; a directory that cannot be written,
/// or that others may write to, affects only the saving. Existing files are loaded also from a read-only directory.
/// Above `max_bytes`, the least recently used files are removed.
class FileCache {
 public:
  /// @param directory  made if it does not exist; empty: nothing is read or written.
  /// @param lock_seconds  upper bound of the time to wait for another process, for each file.
  explicit FileCache(std::string directory, double lock_seconds = 60.0, std::size_t max_bytes = kMaxBytes)
      : directory_(std::move(directory)), lock_seconds_(lock_seconds), max_bytes_(max_bytes) {}

  static constexpr std::size_t kMaxBytes = std::size_t{4} << 30;

  struct Actions {
    std::function<void(const std::string& path)> load;  ///< throws std::runtime_error if the file is not good
    std::function<void()> make;
    std::function<void(const std::string& path)> save;  ///< throws std::runtime_error if it cannot
  };

  /// Loads the file, or makes its content and saves it. What make() throws passes through. @throws Cancelled too.
  CacheOutcome get(const std::string& name, const Actions& actions) const;

 private:
  struct Identity;
  bool load(const std::string& name, const Actions& actions, CacheOutcome& outcome) const;

  std::string directory_;
  double lock_seconds_;
  std::size_t max_bytes_;
};

}  // namespace sdf_ccd
