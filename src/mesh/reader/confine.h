#pragma once

#include "mesh/import/read_limits.h"

namespace sdf_ccd {

/// Drops all privileges that reading does not need. Call it, after detachFromHost(), before this process looks at
/// untrusted data.
///
/// Afterwards the process has only stdin, stdout and stderr open; it cannot exceed the memory, CPU time and stack of
/// the limits; it cannot open files or sockets, start processes, threads or programs, write to regular files, dump
/// core, or gain privileges by setuid. It is killed when the thread that started it ends, and is the first that the
/// kernel kills when memory is short.
///
/// System calls are filtered (seccomp) on x86_64 and arm64: all but some twenty that work on memory and on open files
/// fail with EPERM. On other processors, and if the kernel has no seccomp, only the resource limits apply.
void confine(const ReadLimits& limits);

/// The part of the confinement that needs no limits, to be called first: closes all files but stdin, stdout and stderr,
/// and lets this process be killed with the host, and first when memory is short.
void detachFromHost();

}  // namespace sdf_ccd
