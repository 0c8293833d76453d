#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>

#include "common/files/descriptor.h"

namespace sdf_ccd {

/// A program that reads its stdin and answers on its stdout. The destructor kills it if it still runs.
///
/// Different instances may be used from several threads at once, whatever the host does with SIGCHLD and SIGPIPE: only
/// this child is waited for, and nothing is written to a pipe. The child gets no other open files, a process group of
/// its own (so that Ctrl-C reaches only the host), default signal handlers, and no environment variable but
/// LD_LIBRARY_PATH.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Thrown when the deadline has passed.
  struct Late {};

  /// @param input  becomes the child's stdin, at its present offset.
  /// @throws std::runtime_error with the reason if it cannot be started.
  ChildProcess(const std::string& program, const std::string& argument, const Descriptor& input,
               Clock::time_point deadline);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for up to `size` bytes of the child's output. @return the number of bytes; 0 at the end of the output.
  /// @throws Late, Cancelled.
  std::size_t read(char* to, std::size_t size);

  /// Waits for the child's end. @return the status of waitpid(), or -1 if the host has reaped it. @throws Late,
  /// Cancelled.
  int wait();

 private:
  bool hasEnded();
  void checkTime() const;

  Clock::time_point deadline_;
  Descriptor output_;
  pid_t pid_ = -1;  // -1 once it is reaped
  int status_ = -1;
};

/// A file in memory with this content, at offset 0. @throws std::runtime_error, Cancelled.
Descriptor memoryFile(const std::string& bytes);

}  // namespace sdf_ccd
