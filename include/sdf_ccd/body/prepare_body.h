#pragma once

#include <string>

#include "sdf_ccd/body/body.h"
#include "sdf_ccd/body/body_options.h"
#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// A body with everything that checks can use: field, shell and its tree, triangles. For whole robots and worlds
/// buildScene() builds less, because it knows the pairs.
///
/// Curved surfaces have a point every third of max_error, flat ones have points along their edges: a ball of 0.1 m
/// takes 400,000 points and several seconds at 1 mm, a hundredth of that at 1 cm.
/// @throws std::invalid_argument if the shape is not valid, or the accuracy needs more memory than a body may take:
/// kMaxFieldBytes of field, kMaxShellPoints.
Body prepareBody(const std::string& name, const Primitive& primitive, const Accuracy& accuracy);

/// The same for a mesh, in its frame. Its faces are oriented outward, and openings are closed.
Body prepareBody(const std::string& name, const TriangleMesh& mesh, const Accuracy& accuracy);

/// The same for several elements. @throws std::invalid_argument also if the description has a failure.
Body prepareBody(const BodyDescription& description, const Accuracy& accuracy);

}  // namespace sdf_ccd
