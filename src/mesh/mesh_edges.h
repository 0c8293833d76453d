#pragma once

#include <cstdint>
#include <vector>

#include "common/cancel_point.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// A triangle's side, named by its vertices in ascending order.
struct EdgeUse {
  std::int32_t low, high;
  std::int32_t triangle;
  bool forward;  ///< the triangle runs from `low` to `high`
};

/// All sides of all triangles, sorted by edge; those of one edge are consecutive, in the order of the triangles.
std::vector<EdgeUse> edgeUses(const TriangleMesh& mesh);

/// Calls visit(first, last) for every edge, with the range of its uses.
template <typename Visit>
void forEachEdge(const std::vector<EdgeUse>& uses, Visit visit) {
  CancelTicks<4096> cancel;
  const EdgeUse* const end = uses.data() + uses.size();
  for (const EdgeUse* first = uses.data(); first != end;) {
    cancel.check();
    const EdgeUse* last = first + 1;
    while (last != end && last->low == first->low && last->high == first->high) ++last;
    visit(first, last);
    first = last;
  }
}

/// How many more of the uses [first, last) of an edge run forward than backward: 0 if its triangles agree about the
/// outside.
inline int imbalance(const EdgeUse* first, const EdgeUse* last) {
  int sum = 0;
  for (; first != last; ++first) sum += first->forward ? 1 : -1;
  return sum;
}

/// Disjoint sets of triangles (Galler & Fischer 1964, with path halving).
class TriangleSets {
 public:
  explicit TriangleSets(std::size_t count);
  std::int32_t find(std::int32_t triangle);
  void join(std::int32_t first, std::int32_t second);

 private:
  std::vector<std::int32_t> parent_;
};

/// Per vertex, its component of the surface (connected over shared vertices), named by one of the component's
/// triangles; -1 for vertices that no triangle uses.
std::vector<std::int32_t> componentOfVertices(const TriangleMesh& mesh);

}  // namespace sdf_ccd
