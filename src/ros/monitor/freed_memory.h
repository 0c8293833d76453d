#pragma once

namespace sdf_ccd {

/// Returns freed memory to the system. glibc keeps it in the heaps of threads: of no use once the threads that build
/// fields have ended, and held several times over by those that answer queries, which come and go. The end of a heap
/// (up to 64 MB) is returned for the calling thread only.
void returnFreedMemory();

}  // namespace sdf_ccd
