#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/files/regular_file.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// The files that a request over the network may name: those below certain folders, after links are resolved. Whoever
/// can write there may put links in the place of folders at any time: what is opened once the links are resolved
/// follows none.
class RequestFiles {
 public:
  /// @param roots   folders, which need not exist yet; empty: no file may be named.
  /// @param loader  of package://, which need not be below the roots.
  RequestFiles(std::vector<std::string> roots, ResourceLoader loader);

  /// The file's path, without links. @throws std::runtime_error if it is below none of the roots.
  std::string path(const std::string& file) const;

  /// The content of the file at a path. @throws std::runtime_error with the reason.
  Resource read(const std::string& file, std::size_t max_bytes = kMaxFileBytes) const;

  /// The content of a URI or path, see ResourceLoader.
  Resource resource(const std::string& uri) const;

  /// Writes the file at a path: whole, or not at all. @throws std::runtime_error with the reason.
  void write(const std::string& file, const std::string& text) const;

 private:
  std::vector<std::string> roots_;
  ResourceLoader loader_;
};

}  // namespace sdf_ccd
