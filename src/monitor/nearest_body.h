#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Distance from a point to the nearest body at given poses; for the point queries. For a mesh with openings, the error
/// covers that the point may be on either side, and that the nearest surface may be a cap: see
/// DistanceField::meshSample(). Within a body of several elements, the distance and its gradient are those of one
/// element; where elements meet, the surface of the body is farther away, and the error covers that.
struct NearestBody {
  int body = -1;          ///< -1 if no body is known
  double distance = 0.0;  ///< [m], negative inside
  double error = 0.0;     ///< [m]; infinite if bodies are known by their boxes only
  Vector3d gradient_W = Vector3d::Zero();
};

/// Triangles of meshes that have no field, each prepared when it is first needed and kept as long as the mesh is in
/// use. Several searches may share them, in several threads.
class MeshDistances;
/// None yet.
std::shared_ptr<MeshDistances> makeMeshDistances();
/// Frees what was prepared of meshes that are gone; each new search does so too.
void dropUnused(MeshDistances& meshes);

/// Finds the nearest body to points. A body with a distance field is as far as that says; all others are as far as
/// their primitives and the triangles of their meshes are, which need no field.
class NearestBodySearch {
 public:
  /// @param description  of the scene.
  /// @param meshes       null: they are not shared.
  NearestBodySearch(std::shared_ptr<const Scene> scene, std::shared_ptr<const SceneDescription> description,
                    std::shared_ptr<MeshDistances> meshes = nullptr);
  ~NearestBodySearch();

  /// Prepares the meshes of one body, if it has no field. Takes some ten microseconds per triangle the first time.
  /// @return what is uncertain about the body's inside, or why it is left out; empty if there is nothing to say.
  std::string prepare(std::size_t body);

  /// Whether the body is left out: it has no geometry, or is bad, or is not prepared.
  bool isIgnored(std::size_t body) const;

  /// The nearest of the bodies that are prepared. @param X_WB  per body of the scene.
  NearestBody nearest(const std::vector<Isometry3d>& X_WB, const Vector3d& p_W) const;

 private:
  class Element;

  static double greatestDepth(const std::vector<Element>& elements, const Vector3d& p_B);

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const SceneDescription> description_;
  std::shared_ptr<MeshDistances> meshes_;
  std::vector<std::vector<Element>> elements_;  // per body; empty until it is prepared
};

}  // namespace sdf_ccd
