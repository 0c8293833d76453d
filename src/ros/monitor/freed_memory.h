#pragma once

#include <malloc.h>

namespace sdf_ccd {

/// Returns freed memory to the system. glibc keeps it in the heap of the thread that allocated it: of no use once the
/// threads that build fields have ended, and held several times over by those that answer queries, which come and go.
inline void returnFreedMemory() {
  malloc_trim(0);
}

}  // namespace sdf_ccd
