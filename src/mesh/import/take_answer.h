#pragma once

#include <functional>

#include "mesh/import/read_apart.h"
#include "mesh/import/read_limits.h"

namespace sdf_ccd {

/// Supplies up to `size` bytes. @return the number of bytes, at least one. @throws at the end of the data, with the
/// reason.
using ByteSource = std::function<std::size_t(char* to, std::size_t size)>;

/// Receives and validates the answer of sdf_ccd_read (see read_answer.h): a process that reads untrusted files may be
/// compromised. Memory grows only with the data received.
/// @throws std::runtime_error with the error that the answer holds, or why the answer is invalid; exceptions of the
/// source.
ReadMesh receiveAnswer(const ByteSource& source, const ReadLimits& limits);

/// The message for exceeded memory limits.
std::string tooMuchMemory(const ReadLimits& limits);

}  // namespace sdf_ccd
