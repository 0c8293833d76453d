#include "confine.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/files/descriptor.h"

namespace sdf_ccd {
namespace {

constexpr rlim_t kStackBytes = 8 << 20;

void limit(int resource, rlim_t soft, rlim_t hard) {
  struct rlimit before;
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &before) == 0) {
    if (before.rlim_max < hard) hard = before.rlim_max;
    if (hard < soft) soft = hard;
  }
  const struct rlimit limits = {soft, hard};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &limits);
}

void closeAllAbove(int highest) {
#ifdef SYS_close_range
  if (::syscall(SYS_close_range, highest + 1, ~0U, 0) == 0) return;
#endif
  struct rlimit files = {1024, 1024};
  ::getrlimit(RLIMIT_NOFILE, &files);
  constexpr rlim_t kMaxFiles = 1 << 20;
  for (int file = highest + 1; file < static_cast<int>(std::min(files.rlim_cur, kMaxFiles)); ++file) ::close(file);
}

void preferToDie() {
  const Descriptor file(::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC));
  if (file.isOpen()) writeAll(file.number(), "1000", 4);
}

#if defined(__x86_64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned kArchitecture = 0;
#endif

/// Calls for memory, for files that are already open, for time, and for ending this process.
constexpr unsigned kAllowed[] = {
    SYS_read,       SYS_write,          SYS_readv,         SYS_writev,         SYS_lseek,        SYS_close,
    SYS_mmap,       SYS_munmap,         SYS_mremap,        SYS_mprotect,       SYS_madvise,      SYS_brk,
    SYS_futex,      SYS_sched_yield,    SYS_clock_gettime, SYS_gettimeofday,   SYS_getrandom,    SYS_getpid,
    SYS_gettid,     SYS_tgkill,         SYS_rt_sigaction,  SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_exit,
    SYS_exit_group, SYS_restart_syscall};

void filterSystemCalls() {
  if (kArchitecture == 0) return;
  std::vector<sock_filter> filter = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
                                     BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
                                     BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL),
                                     BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr))};
  for (const unsigned call : kAllowed) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  const sock_fprog program = {static_cast<unsigned short>(filter.size()), filter.data()};
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0);
}

// These sanitizers reserve terabytes of address space at start-up, so RLIMIT_AS cannot be set.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

}  // namespace

void detachFromHost() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  struct pollfd answer = {STDOUT_FILENO, 0, 0};
  if (::poll(&answer, 1, 0) > 0 && (answer.revents & POLLERR)) ::_exit(0);  // the host ended before the prctl() call
  closeAllAbove(STDERR_FILENO);
  preferToDie();
}

void confine(const ReadLimits& limits) {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
  const auto seconds = static_cast<rlim_t>(std::ceil(limits.cpu_seconds));
  limit(RLIMIT_CPU, seconds, seconds + 1);
  if (!kSanitized) limit(RLIMIT_AS, limits.memory, limits.memory);
  limit(RLIMIT_STACK, kStackBytes, kStackBytes);
  limit(RLIMIT_FSIZE, 0, 0);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_NPROC, 0, 0);
  limit(RLIMIT_NOFILE, 0, 0);
  limit(RLIMIT_MEMLOCK, 0, 0);
  limit(RLIMIT_MSGQUEUE, 0, 0);
  filterSystemCalls();
}

}  // namespace sdf_ccd
