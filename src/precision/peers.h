#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measurement.h"
#include "sdf_ccd/query/segment_query.h"

/// The systems that studies compare: this package, and other libraries if a program provides them.
namespace sdf_ccd::precision {

/// The name of a system in a row.
struct Label {
  std::string system;
  std::string setting;
  double value = Measurement::kNone;
  double bound = Measurement::kNone;
};

/// Parameters in [0, 1] at which segments first meet the surface, negative where they do not.
struct HitSystem {
  Label label;
  std::function<void(const std::vector<Segment>&, std::vector<double>&)> first_hits;
};

/// Signed distances at points [m].
struct DistanceSystem {
  Label label;
  std::function<double(const Vector3d&)> distance;
};

/// First time in [0, 1] at which a body that moves with a constant twist touches one at rest, negative if it does not.
struct ImpactSystem {
  Label label;
  std::function<double(const Isometry3d& X_FP_start, const Isometry3d& X_FP_end)> impact;
};

/// Other libraries. Empty functions are left out.
struct Peers {
  std::function<std::vector<HitSystem>(const TriangleMesh&)> mesh_hits;
  std::function<std::vector<HitSystem>(const TriangleMesh&, int cells)> grid_hits;
  std::function<std::vector<DistanceSystem>(const TriangleMesh&, int cells)> grid_distances;
  std::function<std::vector<ImpactSystem>(const TriangleMesh& field, const TriangleMesh& shell)> impacts;
};

}  // namespace sdf_ccd::precision
