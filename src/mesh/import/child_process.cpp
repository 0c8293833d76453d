#include "mesh/import/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include "common/cancel_point.h"

namespace sdf_ccd {
namespace {

constexpr int kPollMilliseconds = 20;  // a cancelled read ends within this time
constexpr int kPipeBytes = 1 << 20;
constexpr std::size_t kChunk = std::size_t{1} << 24;

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::runtime_error(what + ": " + std::strerror(error));
}

/// Moves an open file to a descriptor above stdin, stdout and stderr: if the host has closed those, new files get their
/// numbers.
Descriptor aboveStandard(int number) {
  if (number < 0) fail("no file can be opened", errno);
  Descriptor low(number);
  if (number > STDERR_FILENO) return low;
  Descriptor high(::fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  if (!high.isOpen()) fail("no file can be opened", errno);
  return high;
}

/// Null-terminated array of pointers, as for exec(). The strings must outlive it.
std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(&text[0]);
  pointers.push_back(nullptr);
  return pointers;
}

/// File actions and attributes for posix_spawn().
class SpawnSettings {
 public:
  SpawnSettings(int input, int output) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_addclose(&actions_, STDERR_FILENO);
    sigset_t all, none;
    ::sigfillset(&all);
    ::sigemptyset(&none);
    ::posix_spawnattr_setsigdefault(&attributes_, &all);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::string& argument, const Descriptor& input,
                           Clock::time_point deadline)
    : deadline_(deadline) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail(program + " cannot be started", errno);
  Descriptor answer(ends[1]);
  output_ = aboveStandard(ends[0]);
  answer = aboveStandard(answer.release());
  ::fcntl(output_.number(), F_SETFL, O_NONBLOCK);
  ::fcntl(output_.number(), F_SETPIPE_SZ, kPipeBytes);  // for fewer reads; the user's quota may refuse it

  std::vector<std::string> words = {program, argument}, environment;
  if (const char* path = std::getenv("LD_LIBRARY_PATH")) environment.push_back(std::string("LD_LIBRARY_PATH=") + path);
  const std::vector<char*> argv = pointersTo(words), envp = pointersTo(environment);
  const SpawnSettings settings(input.number(), answer.number());
  const int error =
      ::posix_spawn(&pid_, program.c_str(), settings.actions(), settings.attributes(), argv.data(), envp.data());
  if (error != 0) {
    pid_ = -1;
    fail(program + " cannot be started", error);
  }
}

ChildProcess::~ChildProcess() {
  // Test hasEnded() first: if the host ignores SIGCHLD, the pid of an ended child may already be another process's.
  if (pid_ < 0 || hasEnded()) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::size_t ChildProcess::read(char* to, std::size_t size) {
  for (;;) {
    // A process that another thread of the host forked meanwhile may hold the pipe's write end open until it calls
    // exec(): there is no EOF then, so the end of the child is tested too, before the read.
    const bool ended = hasEnded();
    const ssize_t count = ::read(output_.number(), to, size);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno == EINTR) continue;
    if (errno != EAGAIN || ended) return 0;
    struct pollfd ready = {output_.number(), POLLIN, 0};
    ::poll(&ready, 1, kPollMilliseconds);
    checkTime();
  }
}

int ChildProcess::wait() {
  auto pause = std::chrono::microseconds(50);
  while (!hasEnded()) {
    checkTime();
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(1000 * kPollMilliseconds));
  }
  return status_;
}

bool ChildProcess::hasEnded() {
  if (pid_ < 0) return true;
  const pid_t reaped = ::waitpid(pid_, &status_, WNOHANG);
  if (reaped == 0 || (reaped < 0 && errno == EINTR)) return false;
  if (reaped < 0) status_ = -1;
  pid_ = -1;
  return true;
}

void ChildProcess::checkTime() const {
  checkCancelled();
  if (Clock::now() > deadline_) throw Late();
}

Descriptor memoryFile(const std::string& bytes) {
  Descriptor file = aboveStandard(::memfd_create("sdf_ccd", MFD_CLOEXEC));
  for (std::size_t done = 0; done < bytes.size();) {
    checkCancelled();
    const ssize_t count = ::write(file.number(), bytes.data() + done, std::min(bytes.size() - done, kChunk));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("no memory for a copy of it", errno);
    done += static_cast<std::size_t>(count);
  }
  if (::lseek(file.number(), 0, SEEK_SET) != 0) fail("no memory for a copy of it", errno);
  return file;
}

}  // namespace sdf_ccd
