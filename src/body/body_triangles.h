#pragma once

#include <memory>
#include <vector>

#include "body/mesh_pool.h"
#include "geometry/box_tree.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// What decides where a body touches: its triangles, frame B. Of meshes as they are, open where those are open; balls
/// are exact, cylinders tessellated.
struct BodyTriangles {
  explicit BodyTriangles(BoxTree triangles) : tree(std::move(triangles)) {}

  BoxTree tree;
  std::unique_ptr<const BoxTree> closed;  ///< with caps in all openings (see findOpenings()); null without any
  double deviation = 0.0;                 ///< of the triangles from the surface, of cylinders [m]

  /// Of each component of the surface, caps too (what is connected over shared vertices), its corners farthest out, in
  /// so many directions. One that is outside a solid whose surface the component does not meet tells that all of it is.
  std::vector<std::vector<Vector3d>> components;

  /// Per element the solid of its mesh, null of a primitive; empty unless BodyOptions::exact_depths asks for them, and
  /// of a body that has a mesh which is not closed.
  std::vector<std::shared_ptr<const Solid>> solids;

  const BoxTree& closedTree() const { return closed ? *closed : tree; }
};

/// Null where that would not be all of the body: of half-spaces and voxels; or too much, beyond half a million
/// triangles.
std::shared_ptr<const BodyTriangles> trianglesOf(const BodyDescription& description, MeshPool& pool);

}  // namespace sdf_ccd
