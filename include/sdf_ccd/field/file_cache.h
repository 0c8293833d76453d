#pragma once

#include <functional>
#include <string>

namespace sdf_ccd {

/// How a cached file came to be.
struct CacheOutcome {
  bool from_cache = false;
  std::string warning;  ///< a damaged file was made again, or the directory cannot be used; empty if all went well
};

/// Files that are expensive to make, kept in a directory under names made from what they depend on.
///
/// Safe against several processes: whoever comes second waits for the first and loads what it made. A file that is
/// damaged or of another version is made again; a directory that cannot be written costs only the saving.
class FileCache {
 public:
  /// @param directory  made if it does not exist; empty: nothing is read or written.
  explicit FileCache(std::string directory) : directory_(std::move(directory)) {}

  struct Actions {
    std::function<void(const std::string& path)> load;  ///< throws std::runtime_error if the file is not good
    std::function<void()> make;
    std::function<void(const std::string& path)> save;  ///< throws std::runtime_error if it cannot
  };

  /// Loads the file, or makes its content and saves it. What make() throws passes through.
  CacheOutcome get(const std::string& name, const Actions& actions) const;

 private:
  std::string directory_;
};

}  // namespace sdf_ccd
