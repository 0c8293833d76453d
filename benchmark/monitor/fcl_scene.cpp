#include "monitor/fcl_scene.h"

#include <algorithm>
#include <stdexcept>

#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "fcl_model.h"
#include "oracle/shapes.h"

namespace sdf_ccd::benchmark {
namespace {

std::shared_ptr<fcl::CollisionGeometryd> geometryOf(const GeometryDescription& geometry) {
  if (const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape)) return fclModel(**mesh);
  const Primitive& primitive = std::get<Primitive>(geometry.shape);
  if (const auto* box = std::get_if<Box>(&primitive)) return fclModel(test::boxMesh(box->halfSize()));
  if (const auto* sphere = std::get_if<Sphere>(&primitive)) return std::make_shared<fcl::Sphered>(sphere->radius);
  if (const auto* cylinder = std::get_if<Cylinder>(&primitive))
    return std::make_shared<fcl::Cylinderd>(cylinder->radius, cylinder->length);
  throw std::invalid_argument("FCL scene: a half-space");
}

}  // namespace

FclScene::FclScene(const std::vector<BodyDescription>& bodies) {
  for (const BodyDescription& body : bodies) add(body);
}

int FclScene::add(const BodyDescription& description) {
  FclBody& body = bodies_.emplace_back();
  for (const GeometryDescription& geometry : description.geometry) {
    const std::shared_ptr<fcl::CollisionGeometryd> made = geometryOf(geometry);
    made->computeLocalAABB();
    body.elements.push_back({geometry.X_BG, std::make_unique<fcl::CollisionObjectd>(made)});
  }
  return static_cast<int>(bodies_.size()) - 1;
}

int FclScene::add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry) {
  bodies_.emplace_back().elements.push_back(
      {Isometry3d::Identity(), std::make_unique<fcl::CollisionObjectd>(geometry)});
  const int index = static_cast<int>(bodies_.size()) - 1;
  move(index, Isometry3d::Identity());
  return index;
}

void FclScene::move(int index, const Isometry3d& X_WB) {
  FclBody& body = bodies_[index];
  body.box_W = fcl::AABBd();
  for (Element& element : body.elements) {
    element.object->setTransform(X_WB * element.X_BG);
    element.object->computeAABB();
    body.box_W += element.object->getAABB();
  }
}

bool FclScene::collide(int a, int b) const {
  if (!bodies_[a].box_W.overlap(bodies_[b].box_W)) return false;
  const fcl::CollisionRequestd request;
  for (const Element& one : bodies_[a].elements) {
    for (const Element& other : bodies_[b].elements) {
      fcl::CollisionResultd result;
      if (fcl::collide(one.object.get(), other.object.get(), request, result) > 0) return true;
    }
  }
  return false;
}

double FclScene::distance(int a, int b, double nearer_than) const {
  double nearest = nearer_than;
  for (const Element& one : bodies_[a].elements) {
    for (const Element& other : bodies_[b].elements) {
      if (one.object->getAABB().distance(other.object->getAABB()) >= nearest) continue;
      fcl::DistanceResultd result;
      result.min_distance = nearest;
      nearest = std::min(nearest, fcl::distance(one.object.get(), other.object.get(), fcl::DistanceRequestd(), result));
    }
  }
  return nearest;
}

FclScene::Ball FclScene::ball(int body) const {
  const fcl::AABBd& box = bodies_[body].box_W;
  return {box.center(), 0.5 * (box.max_ - box.min_).norm()};
}

}  // namespace sdf_ccd::benchmark
