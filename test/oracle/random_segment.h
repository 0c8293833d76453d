#pragma once

#include <cmath>

#include "oracle/random.h"
#include "oracle/uniform_walk.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::test {

/// A random segment; kinds: any, short, axis-parallel, on faces, edges and corners of cells, and of nearly no length.
inline Segment randomSegment(const DistanceField& field, Random& random, int kind) {
  const Lattice shape = latticeOf(field);
  const AlignedBox3d box = shape.box();
  const AlignedBox3d wide{box.min() - 0.1 * box.sizes(), box.max() + 0.1 * box.sizes()};
  Segment s{uniformIn(random, wide), uniformIn(random, wide)};
  const auto snap = [&](Vector3d p, int axes) {
    for (int k = 0; k < axes; ++k)
      p[k] = shape.origin[k] + shape.cell * std::round((p[k] - shape.origin[k]) / shape.cell);
    return p;
  };
  switch (kind % 8) {
    case 1:
      s.end = s.start + 3 * shape.cell * direction(random);
      break;
    case 2:
      s.end[0] = s.start[0];
      break;
    case 3:
      s.end[0] = s.start[0];
      s.end[1] = s.start[1];
      break;
    case 4:
      s = {snap(s.start, 1), snap(s.end, 1)};
      s.end[0] = s.start[0];
      break;
    case 5:
      s = {snap(s.start, 3), snap(s.end, 3)};
      break;
    case 6:
      s = {snap(s.start, 2), snap(s.end, 2)};
      s.end[0] = s.start[0];
      s.end[1] = s.start[1];
      break;
    case 7:
      s.end = s.start + uniform(random, 0, 1e-9) * direction(random);
      break;
    default:
      break;
  }
  return s;
}

}  // namespace sdf_ccd::test
