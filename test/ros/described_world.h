#pragma once

#include "ros/world/describe_scene.h"

namespace sdf_ccd::test {

/// What a loop has to know of a scene without a robot, whose fixed frame is "world".
inline DescribedScene describedWorld() {
  DescribedScene described;
  described.fixed_frame = "world";
  return described;
}

}  // namespace sdf_ccd::test
