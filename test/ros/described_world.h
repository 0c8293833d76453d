#pragma once

#include "ros/world/describe_scene.h"

namespace sdf_ccd::test {

/// A scene without a robot for a loop; the fixed frame is "world".
inline DescribedScene describedWorld() {
  DescribedScene described;
  described.fixed_frame = "world";
  return described;
}

}  // namespace sdf_ccd::test
