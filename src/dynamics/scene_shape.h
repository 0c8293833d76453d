#pragma once

#include <optional>

#include "common/settings/settings_reader.h"
#include "dynamics/collision_shape.h"
#include "sdf_ccd/simulation.h"

namespace sdf_ccd {

/// A shape of a scene file, built.
struct SceneShape {
  std::shared_ptr<const CollisionShape> collision;
  std::shared_ptr<const TriangleMesh> mesh_B;  ///< null for a half-space
  std::optional<MassProperties> unit;          ///< at 1 kg/m³; none if the volume of the geometry is uncertain
  std::string doubt;                           ///< the problem of a mesh that is not closed; else empty
  Vector3d center = Vector3d::Zero();          ///< of mass, in the frame that the geometry was given in [m]
};

/// Reads and builds one entry of `shapes`.
SceneShape buildSceneShape(SettingsReader shape, const std::string& directory);

}  // namespace sdf_ccd
