#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "storage/descriptor.h"

namespace sdf_ccd {

/// The program, its arguments and its environment.
struct ProgramCall {
  std::string program;
  std::vector<std::string> arguments;
  std::vector<const char*> variables = {};  ///< of the environment that it gets too, beside LD_LIBRARY_PATH
};

/// A program that reads its stdin, answers on its stdout, and is killed at the latest with its owner.
///
/// May be used from several threads at once, whatever the host does with SIGCHLD and SIGPIPE: only this process is
/// waited for, and nothing is written to a pipe. It gets no other open file, a process group of its own (so that
/// Ctrl-C is the host's affair), default signals, and nothing else of the environment.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Thrown when the deadline has passed.
  struct Late {};

  /// @param input  becomes its stdin, at its present offset. Not open: it gets none.
  /// @throws std::runtime_error with the reason if it cannot be started.
  ChildProcess(const ProgramCall& call, const Descriptor& input, Clock::time_point deadline);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for up to `size` bytes of its answer. @return how many; 0 when it has said all. @throws Late, Cancelled.
  std::size_t read(char* to, std::size_t size);

  /// Waits for its end. @return the status of waitpid(), or -1 if the host has reaped it. @throws Late, Cancelled.
  int wait();

 private:
  bool hasEnded();
  void checkTime() const;

  Clock::time_point deadline_;
  Descriptor output_;
  pid_t pid_ = -1;  // until it is reaped
  int status_ = -1;
};

/// A file in memory with this content, at offset 0. @throws std::runtime_error, Cancelled.
Descriptor memoryFile(const std::string& bytes);

}  // namespace sdf_ccd
