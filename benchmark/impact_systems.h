#pragma once

#include <functional>
#include <vector>

#include "precision/peers.h"

namespace sdf_ccd::benchmark {

/// Factories of systems that find times of impact. Each is in a file of its own that registers it here before main().
using ImpactFactory =
    std::function<std::vector<precision::ImpactSystem>(const TriangleMesh& field, const TriangleMesh& shell)>;

inline std::vector<ImpactFactory>& impactFactories() {
  static std::vector<ImpactFactory> factories;
  return factories;
}

struct RegisteredImpact {
  explicit RegisteredImpact(ImpactFactory factory) { impactFactories().push_back(std::move(factory)); }
};

}  // namespace sdf_ccd::benchmark
