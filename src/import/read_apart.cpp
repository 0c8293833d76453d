#include "import/read_apart.h"

#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <stdexcept>

#include "common/number_text.h"
#include "import/child_process.h"
#include "import/helper_program.h"
#include "import/read_answer.h"
#include "import/read_limits.h"
#include "import/take_answer.h"

namespace sdf_ccd {
namespace {

std::string stopped(const std::string& why) {
  return "the reader was stopped: it needed more than " + why;
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

/// Error text for a reader that ended without an answer. @param status  of waitpid(), or -1.
std::string reasonOf(int status, const ReadLimits& limits) {
  if (status == -1) return "the reader ended without an answer";
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) return stopped(numberText(limits.cpu_seconds) + " s of computing");
    if (signal == SIGKILL) return "the reader was killed (SIGKILL), probably because the computer ran out of memory";
    return "the reader crashed (" + signalName(signal) + ")";
  }
  if (WEXITSTATUS(status) == kExitOutOfMemory) return tooMuchMemory(limits);
  return "the reader ended without an answer (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
}

}  // namespace

ReadMesh readSandboxed(const std::string& format, const std::string& bytes) {
  const ReadLimits limits = limitsOf(format, bytes.size());
  const std::string program = helperProgram("sdf_ccd_read", "SDF_CCD_READER");
  const Descriptor input = memoryFile(bytes);
  const auto time =
      std::chrono::duration_cast<ChildProcess::Clock::duration>(std::chrono::duration<double>(limits.wall_seconds));
  ChildProcess child({program, {format}}, input, ChildProcess::Clock::now() + time);
  const auto source = [&](char* to, std::size_t size) {
    const std::size_t count = child.read(to, size);
    if (count == 0) throw std::runtime_error(reasonOf(child.wait(), limits));
    return count;
  };
  try {
    return receiveAnswer(source, limits);
  } catch (const ChildProcess::Late&) {
    throw std::runtime_error(stopped(numberText(limits.wall_seconds) + " s"));
  }
}

}  // namespace sdf_ccd
