#pragma once

#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// The triangles of a body's surface, frame B. Meshes are as given: open ones stay open.
struct BodySurface {
  TriangleMesh mesh;
  TriangleTree tree;
  double deviation;  ///< of the triangles from curved primitives [m]

  BodySurface(TriangleMesh triangles, double deviation)
      : mesh(std::move(triangles)), tree(mesh), deviation(deviation) {}
};

}  // namespace sdf_ccd
