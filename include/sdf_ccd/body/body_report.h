#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

/// What was built for one body; a row of the plan's table.
struct BodyReport {
  std::string name;
  std::string geometry;         ///< "mesh (300 triangles, closed)", "box", …
  std::string field;            ///< "cached", "built 1.2 s", "exact", "shared", "left out"
  std::size_t field_bytes = 0;  ///< a mesh that several bodies have counts for the first
  std::size_t cells = 0;        ///< stored cells
  double field_error = 0.0;     ///< [m]
  std::size_t shell_points = 0;
  std::size_t shell_bytes = 0;
  std::size_t witnesses = 0;  ///< Body::witnesses
  double gap = 0.0;           ///< between its shell's points, against a body with a like shell [m]
  std::size_t pairs = 0;
  ErrorBound bound;   ///< the largest of its pairs; chord: what the options allow for
  std::string solid;  ///< what of its meshes lies inside their solids and was left out; empty if nothing, or cached
  std::vector<std::string> warnings;
};

}  // namespace sdf_ccd
