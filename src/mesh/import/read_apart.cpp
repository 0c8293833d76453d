#include "mesh/import/read_apart.h"

#include <dlfcn.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "common/number_text.h"
#include "mesh/import/child_process.h"
#include "mesh/import/read_answer.h"
#include "mesh/import/read_limits.h"
#include "mesh/import/take_answer.h"

namespace sdf_ccd {
namespace {

namespace fs = std::filesystem;

fs::path libraryFolder() {
  static const char anchor = 0;
  Dl_info info;
  if (::dladdr(&anchor, &info) == 0 || !info.dli_fname) return {};
  std::error_code error;
  return fs::absolute(info.dli_fname, error).parent_path();
}

// Resolved when the library is loaded: its path may be relative, and the host may change its working directory later.
const fs::path kLibraryFolder = libraryFolder();

/// The program for all formats that need no library.
std::string readerProgram() {
  const char* given = std::getenv("SDF_CCD_READER");
  if (given && *given) return given;
  // In the folder `sdf_ccd` beside the library in devel and install spaces alike.
  for (const fs::path& folder : {kLibraryFolder / "sdf_ccd", kLibraryFolder}) {
    const std::string program = (folder / "sdf_ccd_read").string();
    if (::access(program.c_str(), X_OK) == 0 && !fs::is_directory(program)) return program;
  }
  throw std::runtime_error("cannot find the helper program sdf_ccd_read in " + (kLibraryFolder / "sdf_ccd").string() +
                           " or " + kLibraryFolder.string() +
                           "; set the environment variable SDF_CCD_READER to its path");
}

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
  const Descriptor input = memoryFile(bytes);
  const auto time =
      std::chrono::duration_cast<ChildProcess::Clock::duration>(std::chrono::duration<double>(limits.wall_seconds));
  const bool needs_library = format == "dae" || format == "octomap";
  ChildProcess child(readerProgram() + (needs_library ? "_with_libraries" : ""), format, input,
                     ChildProcess::Clock::now() + time);
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
