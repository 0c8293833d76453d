#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measurement.h"
#include "sdf_ccd/query/segment_query.h"

/// The systems that studies compare: this package, and other libraries if the calling program provides them.
namespace sdf_ccd::precision {

/// Computes the parameters in [0, 1] at which segments first meet the surface; negative for those that do not.
struct HitSystem {
  Label label;
  std::function<void(const std::vector<Segment>&, std::vector<double>&)> first_hits;
};

/// Computes the signed distance at a point [m].
struct DistanceSystem {
  Label label;
  std::function<double(const Vector3d&)> distance;
};

/// Computes the time of impact in [0, 1] of a body moving with a constant twist with a body at rest; negative if none.
struct ImpactSystem {
  Label label;
  std::function<double(const Isometry3d& X_FP_start, const Isometry3d& X_FP_end)> impact;
};

/// Factories of the systems of other libraries. An empty function means that there are none.
struct Peers {
  std::function<std::vector<HitSystem>(const TriangleMesh&)> mesh_hits;
  std::function<std::vector<HitSystem>(const TriangleMesh&, int cells)> grid_hits;
  std::function<std::vector<DistanceSystem>(const TriangleMesh&, int cells)> grid_distances;
  std::function<std::vector<ImpactSystem>(const TriangleMesh& field, const TriangleMesh& shell)> impacts;
};

}  // namespace sdf_ccd::precision
