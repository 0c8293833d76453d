#pragma once

#include <tbb/parallel_for.h>

#include "sdf_ccd/geometry/cancel.h"

namespace sdf_ccd {

/// body(i) for all i from begin to end, in parallel, if the calling thread's work is not cancelled meanwhile.
/// @throws Cancelled, and what a body throws.
template <class Index, class Body>
void parallelFor(Index begin, Index end, const Body& body) {
  const CancelPoint cancel;
  tbb::parallel_for(begin, end, [&](Index i) {
    cancel.check();
    body(i);
  });
}

}  // namespace sdf_ccd
