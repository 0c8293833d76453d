#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "common/cancel_point.h"

namespace sdf_ccd {

/// Calls body(first, last) for parts of the range from begin to end, in parallel, unless the calling thread's work is
/// cancelled. A cancellation also stops the bodies, on any thread.
/// @throws Cancelled, and what a body throws.
template <class Index, class Body>
void parallelRanges(Index begin, Index end, const Body& body) {
  const CancelPoint cancel;
  tbb::parallel_for(tbb::blocked_range<Index>(begin, end), [&](const tbb::blocked_range<Index>& range) {
    const TaskCancelScope scope(cancel);
    cancel.check();
    body(range.begin(), range.end());
  });
}

/// body(i) for all i from begin to end; the same otherwise.
template <class Index, class Body>
void parallelFor(Index begin, Index end, const Body& body) {
  const CancelPoint cancel;
  parallelRanges(begin, end, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      cancel.check();
      body(i);
    }
  });
}

}  // namespace sdf_ccd
