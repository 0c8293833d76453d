#pragma once

#include <memory>
#include <vector>

#include <fcl/narrowphase/collision_object.h>

#include "sdf_ccd/body.h"

namespace sdf_ccd::benchmark {

/// The bodies of a scene in FCL: meshes, and boxes as meshes of twelve triangles, as bounding volume hierarchies;
/// spheres and cylinders as primitives. FCL tests only the surfaces of meshes, not their inside.
class FclScene {
 public:
  explicit FclScene(const std::vector<BodyDescription>& bodies);

  /// Adds a body. @return its index.
  int add(const BodyDescription& body);

  /// Adds a body of one geometry, such as an octree, at the world's origin. @return its index.
  int add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry);

  /// Moves a body. @param X_WB  pose of its frame B.
  void move(int body, const Isometry3d& X_WB);

  /// Whether two bodies touch at their present poses.
  bool collide(int a, int b) const;

  /// Distance of two bodies [m], `nearer_than` if they are not nearer than that; 0 or less if they touch.
  double distance(int a, int b, double nearer_than) const;

  /// A bounding ball of a body at its present pose.
  struct Ball {
    Vector3d center_W;
    double radius;
  };
  Ball ball(int body) const;

 private:
  struct Element {
    Isometry3d X_BG;
    std::unique_ptr<fcl::CollisionObjectd> object;
  };
  struct FclBody {
    std::vector<Element> elements;
    fcl::AABBd box_W;
  };
  std::vector<FclBody> bodies_;
};

}  // namespace sdf_ccd::benchmark
