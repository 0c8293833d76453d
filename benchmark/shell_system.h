#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "query/shell_query.h"
#include "sdf_ccd/mesh.h"
#include "shell/point_shell.h"

namespace sdf_ccd::benchmark {

/// Poses of a moving body in the field's frame at the start and the end of a motion. Points move on straight lines
/// between them (paper Eq. 1).
struct PosePair {
  Isometry3d X_FP_start, X_FP_end;
};

/// A body with a field and one with a shell; `field_mesh` and `shell_mesh` are their surfaces, for other libraries.
struct ShellSubject {
  const TriangleMesh& field_mesh;
  const DistanceField& field;
  const TriangleMesh& shell_mesh;
  const PointShell& shell;
  const SphereTree& tree;
};

struct ShellAnswer {
  long pairs_in_contact = 0;
  long contacts = 0;  ///< intervals of shell points; 0 from a system without points
};

/// A system that finds the contacts of a moving body.
class ShellSystem {
 public:
  virtual ~ShellSystem() = default;
  virtual std::string name() const = 0;
  virtual ShellAnswer run(const PosePair* pairs, std::size_t count) = 0;
};

using ShellSystems = std::vector<std::unique_ptr<ShellSystem>>;
using ShellFactory = std::function<void(const ShellSubject&, ShellSystems&)>;

/// Factories of systems. Each is in a file of its own that registers it here before main().
inline std::vector<ShellFactory>& shellFactories() {
  static std::vector<ShellFactory> factories;
  return factories;
}

struct RegisteredShell {
  explicit RegisteredShell(ShellFactory factory) { shellFactories().push_back(std::move(factory)); }
};

}  // namespace sdf_ccd::benchmark
