#include "ros/world/fetch_http.h"

#include <sys/wait.h>

#include <stdexcept>

#include "common/number_text.h"
#include "common/shown_text.h"
#include "import/child_process.h"
#include "import/helper_program.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;

std::string contentFrom(ChildProcess& child, std::size_t max_bytes) {
  std::string bytes;
  for (std::size_t have = 0;;) {
    bytes.resize(have + kChunk);
    const std::size_t count = child.read(&bytes[have], kChunk);
    have += count;
    bytes.resize(have);
    if (have > max_bytes) throw std::runtime_error("larger than " + std::to_string(max_bytes >> 20) + " MiB");
    if (count == 0) break;
  }
  const int status = child.wait();
  if (status != -1 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return bytes;
  const bool has_reason = status != -1 && WIFEXITED(status) && !bytes.empty();
  throw std::runtime_error(has_reason ? shownText(bytes) : "sdf_ccd_fetch ended without an answer");
}

}  // namespace

std::string fetchHttp(const std::string& uri, const FetchLimits& limits) {
  ProgramCall call;
  call.program = helperProgram("sdf_ccd_fetch", "SDF_CCD_FETCH");
  call.arguments = {uri, std::to_string(limits.bytes)};
  call.variables = {"http_proxy", "https_proxy", "HTTPS_PROXY",   "all_proxy",   "ALL_PROXY",
                    "no_proxy",   "NO_PROXY",    "SSL_CERT_FILE", "SSL_CERT_DIR"};
  const auto time =
      std::chrono::duration_cast<ChildProcess::Clock::duration>(std::chrono::duration<double>(limits.seconds));
  ChildProcess child(call, Descriptor(), ChildProcess::Clock::now() + time);
  try {
    return contentFrom(child, limits.bytes);
  } catch (const ChildProcess::Late&) {
    throw std::runtime_error("not downloaded within " + numberText(limits.seconds) + " s");
  }
}

}  // namespace sdf_ccd
