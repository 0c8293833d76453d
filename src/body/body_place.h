#pragma once

#include "sdf_ccd/body/body.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// Sets what a description says of a body besides its geometry. Bodies of equal geometry differ in nothing else.
inline void setPlace(const BodyDescription& description, Body& body) {
  body.name = description.name;
  body.frame = description.frame;
  body.X_frame_B = description.X_frame_B;
  body.is_world = description.is_world;
  body.map = description.map;
  body.failure = description.failure;
}

/// Whether setPlace() would leave the body unchanged.
inline bool hasPlace(const Body& body, const BodyDescription& description) {
  return body.name == description.name && body.frame == description.frame &&
         body.X_frame_B.matrix() == description.X_frame_B.matrix() && body.is_world == description.is_world &&
         body.map == description.map && body.failure == description.failure;
}

}  // namespace sdf_ccd
