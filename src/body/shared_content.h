#pragma once

#include "body/geometry_keys.h"
#include "common/weak_store.h"

namespace sdf_ccd {

struct BodyTriangles;
struct BuiltBody;

/// What bodies of equal content share, for as long as one of them exists. Thread-safe.
struct SharedContent {
  WeakStore<BuiltBody> bodies;
  WeakStore<BodyTriangles> triangles;
};

}  // namespace sdf_ccd
