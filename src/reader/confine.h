#pragma once

#include "import/read_limits.h"

namespace sdf_ccd {

/// Gives up, before this process looks at untrusted data, all privileges that reading does not need.
///
/// Gone are: all open files but stdin, stdout and stderr; more memory, computing time and stack than the limits say;
/// new files, sockets, processes, threads and programs; written files and core dumps; privileges by setuid. It ends
/// with the thread that started it, and is the first to go where the computer's memory is short.
///
/// System calls are filtered (seccomp) on x86_64 and arm64: all but some twenty that work on memory and on what is open
/// fail with EPERM. Elsewhere, and where the kernel has no seccomp, the resource limits alone hold.
void confine(const ReadLimits& limits);

/// The part of it that needs no limits, to be done first: closes files, and ends with the host.
void leaveHost();

}  // namespace sdf_ccd
