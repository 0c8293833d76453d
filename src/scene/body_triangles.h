#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mesh/voxel_solid.h"
#include "scene/mesh_pool.h"
#include "sdf_ccd/body.h"
#include "surface/box_tree.h"

namespace sdf_ccd {

/// Triangles of a body, frame B, which decide contact. Meshes are as drawn, open where those are open; spheres are
/// exact, cylinders tessellated; the faces of voxels are joined to rectangles.
struct BodyTriangles {
  explicit BodyTriangles(BoxTree triangles) : tree(std::move(triangles)) {}

  BoxTree tree;
  std::unique_ptr<const BoxTree> closed;  ///< with caps in all openings (see findOpenings()); null without any
  std::vector<int> element;               ///< per triangle of `tree`; empty if there is only one element
  int elements = 1;                       ///< their number
  bool is_cracked = false;                ///< one element, whose openings are cracks: it is solid all the same
  double deviation = 0.0;                 ///< of the triangles from the surface: of cylinders, voxels, joined faces [m]

  struct Voxels {
    int element;
    Isometry3d X_GB;  ///< G: the mesh's frame
    std::shared_ptr<const VoxelSolid> solid;
  };
  std::vector<Voxels> voxels;  ///< the elements that are voxels

  /// For each component of the surface, with caps (connected by shared vertices): its extreme vertices in some
  /// directions. If one is outside a solid whose surface the component does not meet, the whole component is.
  std::vector<std::vector<Vector3d>> components;

  std::size_t bytes() const;

  const BoxTree& closedTree() const { return closed ? *closed : tree; }

  /// Whether a point off the surface is certainly outside all elements. The meshes must be closed, and their signs
  /// trusted (MeshQuality::sign_trusted).
  bool isOutside(const Vector3d& p) const;

  /// Whether a point off the surface is certainly inside an element. The signs of the meshes must be trusted, and none
  /// may take cavities for solid.
  bool isInside(const Vector3d& p) const;

 private:
  const Voxels* voxelsOf(int element) const;
  std::optional<int> windingNumberOf(int element, const Vector3d& p) const;
};

/// Of the body's bounded elements; null if it has none.
/// @throws std::invalid_argument if there are more than a body may have, or voxels that are none.
std::shared_ptr<const BodyTriangles> trianglesOf(const BodyDescription& description, MeshPool& pool);

}  // namespace sdf_ccd
