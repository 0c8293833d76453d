#pragma once

#include <tbb/parallel_for.h>

#include "sdf_ccd/geometry/cancel.h"

namespace sdf_ccd {

/// body(i) for all i from begin to end, in parallel, if the calling thread's work is not cancelled meanwhile. What ends
/// that also ends what the bodies do, whichever thread they are on.
/// @throws Cancelled, and what a body throws.
template <class Index, class Body>
void parallelFor(Index begin, Index end, const Body& body) {
  const CancelPoint cancel;
  tbb::parallel_for(begin, end, [&](Index i) {
    cancel.check();
    const CancelScope scope(cancel);
    body(i);
  });
}

}  // namespace sdf_ccd
