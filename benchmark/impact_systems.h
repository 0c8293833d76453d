#pragma once

#include <functional>
#include <vector>

#include "precision/measurement.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::benchmark {

/// Computes the time of impact in [0, 1] of a body moving with a constant twist with a body at rest; negative if none.
struct ImpactSystem {
  precision::Label label;
  std::function<double(const Isometry3d& X_FP_start, const Isometry3d& X_FP_end)> impact;
};

/// Factories of systems that find times of impact. Each is in a file of its own that registers it here before main().
using ImpactFactory = std::function<std::vector<ImpactSystem>(const TriangleMesh& rests, const TriangleMesh& moves)>;

inline std::vector<ImpactFactory>& impactFactories() {
  static std::vector<ImpactFactory> factories;
  return factories;
}

struct RegisteredImpact {
  explicit RegisteredImpact(ImpactFactory factory) { impactFactories().push_back(std::move(factory)); }
};

}  // namespace sdf_ccd::benchmark
