#include "process/read_apart.h"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "process/child_process.h"
#include "process/helper_program.h"
#include "process/read_answer.h"
#include "process/read_limits.h"
#include "sdf_ccd/geometry/number_text.h"

namespace sdf_ccd {
namespace {

constexpr std::uint64_t kMaxReason = 1000;            // bytes
constexpr std::size_t kChunk = std::size_t{1} << 16;  // elements: memory grows only with what has come

std::string stopped(const std::string& why) {
  return "the reader was stopped: it needed more than " + why;
}

std::string tooMuchMemory(const ReadLimits& limits) {
  return stopped(std::to_string(limits.memory >> 20) + " MB");
}

std::string signalName(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGABRT:
      return "SIGABRT";
    case SIGBUS:
      return "SIGBUS";
    case SIGFPE:
      return "SIGFPE";
    case SIGILL:
      return "SIGILL";
    case SIGKILL:
      return "SIGKILL";
    case SIGSYS:
      return "SIGSYS";
    default:
      return "signal " + std::to_string(signal);
  }
}

/// Why there is no answer.
std::string reasonOf(int status, const ReadLimits& limits) {
  if (status == -1) return "the reader ended without an answer";
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) return stopped(numberText(limits.cpu_seconds) + " s of computing");
    if (signal == SIGKILL) return "the reader was killed (SIGKILL), as happens where memory is short";
    return "the reader crashed (" + signalName(signal) + ")";
  }
  if (WEXITSTATUS(status) == kExitOutOfMemory) return tooMuchMemory(limits);
  return "the reader ended without an answer (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
}

/// Names and numbers of a hostile file: as log and terminal can take them.
std::string printable(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

/// The answer of one reader, believed only as far as it is checked.
class AnswerReader {
 public:
  AnswerReader(ChildProcess& child, const ReadLimits& limits) : child_(child), limits_(limits) {}

  ReadMesh read() {
    ReadAnswer answer;
    take(reinterpret_cast<char*>(&answer), sizeof answer);
    if (answer.magic != ReadAnswer::kMagic) throw std::runtime_error("the reader is of another version, or damaged");
    if (answer.reason_bytes > 0) throw std::runtime_error(takeReason(answer.reason_bytes));
    // Whatever the reader holds in its memory is no more than it may have.
    const std::uint64_t most = std::min<std::uint64_t>(limits_.memory, std::numeric_limits<int>::max());
    if (answer.vertices > most || answer.triangles > most ||
        answer.vertices * sizeof(Vector3d) + answer.triangles * sizeof(Vector3i) > limits_.memory) {
      throw std::runtime_error(tooMuchMemory(limits_));
    }
    ReadMesh result;
    result.resolution = answer.resolution;
    if (!std::isfinite(result.resolution)) throw std::runtime_error("the reader's answer is damaged");
    takeAll(result.mesh.vertices, answer.vertices);
    takeAll(result.mesh.triangles, answer.triangles);
    try {
      validate(result.mesh);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(error.what());
    }
    return result;
  }

 private:
  void take(char* to, std::size_t size) {
    while (size > 0) {
      const std::size_t count = child_.read(to, size);
      if (count == 0) throw std::runtime_error(reasonOf(child_.wait(), limits_));
      to += count;
      size -= count;
    }
  }

  template <class Element>
  void takeAll(std::vector<Element>& elements, std::uint64_t count) {
    static_assert(sizeof(Element) == 3 * sizeof(typename Element::Scalar), "no padding");
    while (elements.size() < count) {
      const std::size_t have = elements.size();
      elements.resize(have + std::min<std::size_t>(kChunk, count - have));
      take(reinterpret_cast<char*>(elements.data() + have), (elements.size() - have) * sizeof(Element));
    }
  }

  std::string takeReason(std::uint64_t size) {
    std::string reason(std::min(size, kMaxReason), '\0');
    take(&reason[0], reason.size());
    return printable(reason);
  }

  ChildProcess& child_;
  const ReadLimits& limits_;
};

}  // namespace

ReadMesh readApart(const std::string& format, const std::string& bytes) {
  const ReadLimits limits = limitsOf(format, bytes.size());
  const std::string program = helperProgram("sdf_ccd_read", "SDF_CCD_READER");
  const Descriptor input = memoryFile(bytes);
  const auto time =
      std::chrono::duration_cast<ChildProcess::Clock::duration>(std::chrono::duration<double>(limits.wall_seconds));
  ChildProcess child({program, {format}}, input, ChildProcess::Clock::now() + time);
  try {
    return AnswerReader(child, limits).read();
  } catch (const ChildProcess::Late&) {
    throw std::runtime_error(stopped(numberText(limits.wall_seconds) + " s"));
  }
}

}  // namespace sdf_ccd
