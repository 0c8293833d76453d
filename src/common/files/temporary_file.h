#pragma once

#include <string>

#include "common/files/descriptor.h"

namespace sdf_ccd {

/// A file that is written before it gets its name. It has none until then, so that whatever ends the program leaves
/// nothing of it; where the file system has no such files, it has a name of its own in the target's directory, which
/// stays after `kill -9`. Others may at most read it, if the user's umask allows that.
class TemporaryFile {
 public:
  /// @param target  the location that it is for; links are not followed.
  /// @throws std::system_error if none can be made in the target's directory.
  explicit TemporaryFile(const std::string& target);
  /// The same for a target named `name` in an open folder, wherever that is by now.
  TemporaryFile(Descriptor folder, const std::string& name);
  ~TemporaryFile();  ///< without place() the file is removed
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// The path by which this process, and others of the same user while it lives, open it for writing; that of an open
  /// folder's file may no longer lead to it.
  const std::string& path() const { return path_; }

  /// The file itself, open for writing.
  int descriptor() const { return descriptor_.number(); }

  /// Gives the file its target's name, replacing an existing file. All writers must have closed it.
  /// @throws std::system_error if that fails.
  void place();

 private:
  void open(const std::string& directory);
  void openNamed(const std::string& directory);
  void giveName();

  Descriptor folder_;
  std::string target_;  // its name in the folder
  std::string path_;
  std::string name_;  // beside the target; empty if it has none
  Descriptor descriptor_;
};

}  // namespace sdf_ccd
