#pragma once

#include <fstream>
#include <memory>
#include <string>

#include "common/files/temporary_file.h"

namespace sdf_ccd::tools {

/// A file that appears complete or not at all: it is written under a temporary name until commit(). Symbolic links are
/// followed, not replaced. Devices, pipes and open files (/dev/stdout, /dev/fd/3) are appended to immediately.
class OutputFile {
 public:
  /// @throws std::runtime_error if the path cannot be written, so that this is known before the work is done.
  explicit OutputFile(const std::string& path);
  ~OutputFile();  ///< without commit() no file is left
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return stream_; }

  /// Finishes writing. Close several files before the first commit(), so that none appears if one is incomplete.
  /// @throws std::runtime_error if not everything could be written.
  void close();

  /// Closes it first, if it is open. @throws std::runtime_error if the file cannot be moved to its path.
  void commit();

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> temporary_;  // null if the target is written directly
  std::ofstream stream_;
};

/// The same for writers that need a path: they write to part(), and must close it before commit().
class OutputPath {
 public:
  /// @throws std::runtime_error if the path cannot be written.
  explicit OutputPath(const std::string& path);

  const std::string& path() const { return path_; }
  const std::string& part() const { return temporary_->path(); }

  /// @throws std::runtime_error if the file cannot be moved to its path.
  void commit();

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> temporary_;
};

/// Creates a directory. The destructor removes it if it was created here and is empty.
class OutputDirectory {
 public:
  /// @throws std::runtime_error if it cannot be created or written to.
  explicit OutputDirectory(const std::string& path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// Path of a file in it.
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
  bool is_new_ = false;
};

}  // namespace sdf_ccd::tools
