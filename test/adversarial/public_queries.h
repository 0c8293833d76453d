#pragma once

#include <string>
#include <vector>

#include "adversarial/family.h"
#include "sdf_ccd/types.h"

/// Public queries of continuous collision detection with exact truth: Continuous-Collision-Detection/Sample-Queries
/// (Wang et al. 2021), after the degenerate cases of Erleben (2018).
namespace sdf_ccd::test {

/// A vertex and a face, or two edges, each of which is displaced as a whole.
struct PublicQuery {
  std::string name;
  std::vector<Vector3d> a, b;  ///< corners at the start: 1 and 3, or 2 and 2 [m]
  Vector3d path_a, path_b;     ///< by which they are displaced [m]
  bool touches;
};

/// All rigid queries below a folder: those whose elements keep their shape. The others deform, which bodies do not.
/// @throws std::runtime_error if a file is damaged.
std::vector<PublicQuery> readPublicQueries(const std::string& folder);

/// The elements themselves, as triangles of which corners coincide: at resolutions from 1e-9 to 1e-2 m. Judged by the
/// public truth.
Tally publicTriangles(const std::vector<PublicQuery>& queries);

/// Thin convex bodies around the elements, through a monitor. Judged by an oracle of their own, and by the public
/// truth: what touches is never CLEAR.
Tally publicBodies(const std::vector<PublicQuery>& queries);

}  // namespace sdf_ccd::test
