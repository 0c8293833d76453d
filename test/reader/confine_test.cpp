#include "mesh/reader/confine.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace sdf_ccd::confine_test {

/// Whether an attempt succeeds in a child process that has called detachFromHost() and confine().
bool possible(const std::function<bool()>& attempt) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    detachFromHost();
    confine(limitsOf("stl", 1000));
    ::_exit(attempt() ? 1 : 0);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

TEST(Confine, TakesAllThatReadingDoesNotNeed) {
  const int inherited = ::open("/dev/null", O_RDONLY);  // without close-on-exec, like ROS's sockets
  EXPECT_FALSE(possible([&] { return ::fcntl(inherited, F_GETFD) >= 0; }));
  ::close(inherited);
  EXPECT_FALSE(possible([] { return ::open("/dev/null", O_RDONLY) >= 0; }));
  EXPECT_FALSE(possible([] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }));
  EXPECT_FALSE(possible([] { return ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }));
  EXPECT_FALSE(possible([] { return ::execl("/bin/true", "true", nullptr) == 0; }));
  EXPECT_FALSE(possible([] { return ::unlink("/tmp/sdf_ccd_no_such_file") == 0; }));
  EXPECT_FALSE(possible([] {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    return child > 0;
  }));
  EXPECT_FALSE(possible([] {
    struct rlimit more = {RLIM_INFINITY, RLIM_INFINITY};
    return ::setrlimit(RLIMIT_AS, &more) == 0;
  }));
  EXPECT_FALSE(possible([] { return ::kill(::getppid(), 0) == 0; }));
}

TEST(Confine, LeavesMemoryUpToItsLimit) {
  const auto takes = [](std::size_t megabytes) {
    return possible([megabytes] {
      void* memory = ::mmap(nullptr, megabytes << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      return memory != MAP_FAILED;
    });
  };
  EXPECT_TRUE(takes(100));
  EXPECT_FALSE(takes(600));
}

TEST(Confine, LimitsGrowWithTheFileAndNeverBeyondTheComputer) {
  EXPECT_EQ(limitsOf("stl", 0).memory, 512u << 20);
  EXPECT_EQ(limitsOf("stl", 1 << 20).memory, 544u << 20);
  EXPECT_EQ(limitsOf("octomap", 19).memory, (512u << 20) + 38000);
  const std::uint64_t pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const std::uint64_t computer = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  for (const char* format : {"stl", "dae", "octomap"}) {
    const ReadLimits limits = limitsOf(format, 1 << 30);
    EXPECT_LE(limits.memory, computer);
    EXPECT_DOUBLE_EQ(limits.cpu_seconds, 5.0 + 1024.0);
    EXPECT_DOUBLE_EQ(limits.wall_seconds, 6.0 * limits.cpu_seconds);
  }
}

}  // namespace sdf_ccd::confine_test
