// Helper programs of the library (import/read_apart.h): sdf_ccd_read FORMAT < FILE for STL, OBJ, OFF and
// PLY, sdf_ccd_read_with_libraries for DAE and OctoMaps. They read stdin in a confined process, and write the answer
// described in import/read_answer.h to stdout.

#include <malloc.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <limits>
#include <new>
#include <string>

#include "common/files/descriptor.h"
#include "confine.h"
#include "mesh/import/read_answer.h"
#include "mesh/import/read_apart.h"
#include "parse_mesh.h"
#ifdef SDF_CCD_READ_WITH_LIBRARIES
#include "dae_file.h"
#include "parse_octomap.h"
#endif

namespace sdf_ccd {
namespace {

constexpr int kExitNoHost = 4, kExitUsage = 2;
constexpr std::size_t kMaxReason = 1000;
constexpr int kMemoryPiece = 8 << 20;  // bytes

void send(const void* from, std::size_t size) {
  if (!writeAll(STDOUT_FILENO, from, size)) ::_exit(kExitNoHost);
}

void sendReason(std::string reason) {
  reason.resize(std::min(reason.size(), kMaxReason));
  if (reason.empty()) reason = "cannot be read (the reader gave no reason)";
  ReadAnswer answer;
  answer.reason_bytes = reason.size();
  send(&answer, sizeof answer);
  send(reason.data(), reason.size());
}

void sendMesh(const ReadMesh& read) {
  ReadAnswer answer;
  answer.vertices = read.mesh.vertices.size();
  answer.triangles = read.mesh.triangles.size();
  answer.resolution = read.resolution;
  send(&answer, sizeof answer);
  send(read.mesh.vertices.data(), answer.vertices * sizeof(Vector3d));
  send(read.mesh.triangles.data(), answer.triangles * sizeof(Vector3i));
}

std::string readInput(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t have = 0; have < size;) {
    const ssize_t count = ::read(STDIN_FILENO, &bytes[have], size - have);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(kExitNoHost);
    have += static_cast<std::size_t>(count);
  }
  return bytes;
}

/// The new handler: ends the process at once, as some libraries would report std::bad_alloc as an error of the file.
void endOutOfMemory() {
  ::_exit(kExitOutOfMemory);
}

/// Makes malloc() take memory in large pieces and never return it: the process is short-lived, and system calls for
/// memory cost time.
void takeMemoryInLargePieces() {
  ::mallopt(M_TOP_PAD, kMemoryPiece);
  ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  ::mallopt(M_MMAP_THRESHOLD, kMemoryPiece);
}

ReadMesh parse(const std::string& bytes, const std::string& format, [[maybe_unused]] const ReadLimits& limits) {
#ifdef SDF_CCD_READ_WITH_LIBRARIES
  if (format == "octomap") return parseOctomapUnconfined(bytes, limits.memory);
  return {parseDae(bytes)};
#else
  return {parseMeshUnconfined(bytes, format)};
#endif
}

void answer(const std::string& format) {
  detachFromHost();
  struct stat input;
  if (::fstat(STDIN_FILENO, &input) != 0) ::_exit(kExitNoHost);
  const ReadLimits limits = limitsOf(format, static_cast<std::uint64_t>(input.st_size));
  takeMemoryInLargePieces();
  std::set_new_handler(endOutOfMemory);
  confine(limits);
  try {
    const std::string bytes = readInput(static_cast<std::size_t>(input.st_size));
    sendMesh(parse(bytes, format, limits));
  } catch (const std::exception& error) {
    sendReason(error.what());
  }
}

}  // namespace
}  // namespace sdf_ccd

int main(int argc, char** argv) {
  if (argc != 2) return sdf_ccd::kExitUsage;
  sdf_ccd::answer(argv[1]);
  ::_exit(0);  // no destructors: they cost time, and may crash after reading a damaged file
}
