#pragma once

#include <functional>

#include "import/read_apart.h"
#include "import/read_limits.h"

namespace sdf_ccd {

/// Gives up to `size` bytes. @return how many, at least one. @throws where there are no more, with the reason.
using ByteSource = std::function<std::size_t(char* to, std::size_t size)>;

/// Takes the answer of sdf_ccd_read (see read_answer.h) and validates it: a process that
/// reads untrusted files may be compromised. Memory grows only with the data received.
/// @throws std::runtime_error with the reason that the answer gives, or why it cannot be; what the source throws.
ReadMesh takeAnswer(const ByteSource& source, const ReadLimits& limits);

/// The message for exceeded memory limits.
std::string tooMuchMemory(const ReadLimits& limits);

}  // namespace sdf_ccd
