#pragma once

#include <vector>

#include "oracle/random.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::test {

inline DistanceField torus() {
  FieldOptions options;
  options.max_error = 0.001;
  options.band = 0.004;
  return buildField(torusMesh(0.2, 0.08, 48, 24), options);
}

inline DistanceField uniformTorus() {
  FieldOptions options;
  options.cells = 64;
  return buildField(torusMesh(0.2, 0.08, 48, 24), options);
}

/// Long, short, axis-parallel, of no length, far outside.
inline std::vector<Segment> randomSegments(const DistanceField& field, int count) {
  Random random(21);
  const AlignedBox3d box = field.box();
  const AlignedBox3d wide{box.min() - 0.2 * box.sizes(), box.max() + 0.2 * box.sizes()};
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    Segment s{uniformIn(random, wide), uniformIn(random, wide)};
    if (i % 8 == 1) s.end = s.start + 0.01 * direction(random);
    if (i % 8 == 2) s.end.x() = s.start.x();
    if (i % 8 == 3) s.end.head<2>() = s.start.head<2>();
    if (i % 8 == 4) s.end = s.start;
    if (i % 8 == 5) s.start += 1e6 * (s.start - s.end);
    segments.push_back(s);
  }
  return segments;
}

}  // namespace sdf_ccd::test
