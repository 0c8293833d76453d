#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "sdf_ccd/scene/scene_description.h"

namespace sdf_ccd {

/// The world's objects as they are checked, to look at; half-spaces as a thin square of 4 m. Without voxel maps,
/// which rviz has better displays for.
visualization_msgs::MarkerArray toWorldMarkers(const SceneDescription& scene);

}  // namespace sdf_ccd
