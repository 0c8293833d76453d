#pragma once

#include <fstream>
#include <memory>
#include <string>

#include "storage/temporary_file.h"

namespace sdf_ccd::tools {

/// A file that appears complete or not at all: it is written before it has its name, which commit() gives it.
/// Symbolic links stay, and what they lead to is written. Devices, pipes and open files (/dev/stdout, /dev/fd/3) are
/// appended to at once.
class OutputFile {
 public:
  /// @throws std::runtime_error if the path cannot be written, so that it is known before the work is done.
  explicit OutputFile(const std::string& path);
  ~OutputFile();  ///< without commit() nothing stays
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return stream_; }

  /// Ends the writing; of several files, all before the first commit(), so that none is there if one is incomplete.
  /// @throws std::runtime_error if not everything could be written.
  void close();

  /// Closes it first, unless that is done. @throws std::runtime_error if the file cannot be put in its place.
  void commit();

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> temporary_;  // null if the target is written directly
  std::ofstream stream_;
};

/// The same for writers that want a path: they write to part(), and have closed it before commit().
class OutputPath {
 public:
  /// @throws std::runtime_error if the path cannot be written.
  explicit OutputPath(const std::string& path);

  const std::string& path() const { return path_; }
  const std::string& part() const { return temporary_->path(); }

  /// @throws std::runtime_error if the file cannot be put in its place.
  void commit();

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> temporary_;
};

/// Makes a directory; if nothing has been put into it in the end, and it is new, it goes again.
class OutputDirectory {
 public:
  /// @throws std::runtime_error if it cannot be made or written to.
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
