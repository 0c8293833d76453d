#include "threads_option.h"

#include <stdexcept>

namespace sdf_ccd::tools {

void ThreadsOption::addTo(CLI::App& command) {
  command.add_option("--threads", threads, "Threads to use; default one per core");
}

std::unique_ptr<tbb::global_control> ThreadsOption::limit() const {
  if (threads < 0) throw std::invalid_argument("--threads must not be negative");
  if (threads == 0) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

}  // namespace sdf_ccd::tools
