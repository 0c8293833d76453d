#pragma once

#include <optional>
#include <string>

#include "common/settings/settings_reader.h"
#include "sdf_ccd/primitive.h"
#include "sdf_ccd/result.h"

/// What scenes of the monitor and of the simulation have in common.
namespace sdf_ccd {

/// The sizes of a `box` (size), `sphere` (radius), `cylinder` (radius, length) or `plane`; none for other types.
std::optional<Primitive> readPrimitive(SettingsReader& shape, const std::string& type);

/// `xyz` and `rpy` (roll, pitch, yaw), at most kFarthestPose from the origin.
Isometry3d readPose(SettingsReader& reader);
void requireNear(const SettingsReader& reader, const std::string& key, const Vector3d& p);

/// Stiffness, damping, normals and quadrature of a group `contact`.
ContactOptions readContact(SettingsReader& contact);

}  // namespace sdf_ccd
