// Writes the content of an http:// or https:// URI to stdout, or the reason why it cannot: sdf_ccd_fetch URI MAX_BYTES.
// It is a separate process because resource_retriever limits neither time nor size; see ros/world/fetch_http.h.

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>

#include <resource_retriever/retriever.h>

namespace {

constexpr rlim_t kMemory = rlim_t{512} << 20;  // besides the content, whose growing buffer needs twice its size

void send(const void* from, std::size_t size) {
  const char* bytes = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t count = ::write(STDOUT_FILENO, bytes, size);
    if (count <= 0) ::_exit(2);
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

void limit(int resource, rlim_t value) {
  const struct rlimit both = {value, value};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  limit(RLIMIT_AS, kMemory + 4 * std::strtoull(argv[2], nullptr, 10));
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  try {
    const resource_retriever::MemoryResource memory = resource_retriever::Retriever().get(argv[1]);
    send(memory.data.get(), memory.size);
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    send(reason.data(), reason.size());
    ::_exit(1);
  }
  ::_exit(0);
}
