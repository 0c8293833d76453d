#pragma once

#include <memory>
#include <vector>

#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// Decides what is inside a mesh, by winding numbers. They are added over the whole mesh only where they cannot cancel
/// each other wrongly: a cavity must cancel the solid that contains it, but neither an inside-out lobe of a surface
/// that intersects itself nor a sheet that faces the wrong way may cancel a solid that overlaps it.
///
/// A point is inside a closed mesh if the winding number of its parts is not zero; doubtful parts with such a lobe are
/// tested separately. It is inside an open mesh if it is inside the closed parts, or if the winding number of the whole
/// mesh is above one half.
class Interior {
 public:
  /// @param mesh  oriented outward (see orientOutward()).
  /// @param tree  over the same mesh.
  Interior(const TriangleMesh& mesh, std::shared_ptr<const TriangleTree> tree);

  bool closed() const { return closed_; }  ///< see isClosed()
  /// @param visited  see TriangleTree::inside().
  bool contains(const Vector3d& p, std::size_t* visited = nullptr) const;

 private:
  struct Group {
    std::shared_ptr<const TriangleTree> tree;
    TriangleTree::Inside rule;
  };

  bool closed_;
  std::vector<Group> groups_;  ///< a point inside one of them is inside
};

}  // namespace sdf_ccd
