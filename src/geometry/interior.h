#pragma once

#include <memory>
#include <vector>

#include "geometry/triangle_tree.h"

namespace sdf_ccd {

/// What is inside a mesh, by winding numbers. They are added up over the whole mesh only where they cannot cancel each
/// other wrongly: a cavity must cancel what holds it, but a lobe that a surface turns inside out where it crosses
/// itself, or a sheet that faces the wrong way, must not cancel a solid that overlaps it.
///
/// A closed mesh holds the places where the number of all its parts is not zero, those with such a lobe in another part
/// apart. One that is not closed holds what its closed parts hold, and where the number of all together is above one
/// half.
class Interior {
 public:
  /// @param mesh  turned outward (see orientOutward()).
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
  std::vector<Group> groups_;  ///< inside one is inside
};

}  // namespace sdf_ccd
