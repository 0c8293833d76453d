#pragma once

#include <fstream>
#include <string>

namespace sdf_ccd::tools {

/// A file that appears complete or not at all: written beside its place under another name, renamed by commit().
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

  /// @throws std::runtime_error if not everything could be written.
  void commit();

 private:
  std::string path_;
  std::string target_;     // where links lead from path_
  std::string temporary_;  // empty if the target is written directly
  std::ofstream stream_;
};

/// The same for writers that want a path: they write to part(), beside its place.
class OutputPath {
 public:
  explicit OutputPath(const std::string& path) : path_(path) {}
  ~OutputPath();  ///< without commit() nothing stays
  OutputPath(const OutputPath&) = delete;
  OutputPath& operator=(const OutputPath&) = delete;

  std::string part() const { return path_ + ".part"; }
  void commit();

 private:
  std::string path_;
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
