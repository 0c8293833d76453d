#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Distance from a point to the nearest body at given poses; for the point queries. It is that to the surface of the
/// body as a whole, where the body is in a pair and has a certain solid. Else, within a body of several elements, the
/// distance and its gradient are those of one element; where elements meet, the surface of the body is farther away,
/// and the error covers that. For a mesh with openings, the error covers that the point may be on either side, and that
/// the nearest surface may be a cap: see DistanceField::meshSample().
struct NearestBody {
  int body = -1;          ///< -1 if no body is known
  double distance = 0.0;  ///< [m], negative inside
  double error = 0.0;     ///< [m]; infinite if bodies are known by their boxes only
  Vector3d gradient_W = Vector3d::Zero();
};

/// Triangles of meshes that are no certain solid, each prepared when it is first needed and kept as long as the mesh is
/// in use. Several searches may share them, in several threads.
class MeshDistances;
/// None yet.
std::shared_ptr<MeshDistances> makeMeshDistances();
/// Frees what was prepared of meshes that are gone; each new search does so too.
void dropUnused(MeshDistances& meshes);

/// Finds the nearest body to points, by the bodies' surfaces: exactly, up to the error. Fields tell only where there is
/// nothing better, as for meshes of too many triangles, or where approximate distances are wanted.
class NearestBodySearch {
 public:
  /// @param description  of the scene.
  /// @param meshes       null: they are not shared.
  /// @param approximate  bodies with fields are as far as these say, which is faster.
  NearestBodySearch(std::shared_ptr<const Scene> scene, std::shared_ptr<const SceneDescription> description,
                    std::shared_ptr<MeshDistances> meshes = nullptr, bool approximate = false);
  ~NearestBodySearch();

  /// Prepares one body. If it has meshes that are no certain solids, that takes some ten microseconds per triangle the
  /// first time.
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
  bool approximate_;
  // Per body; both empty until it is prepared:
  std::vector<std::shared_ptr<const DepthSolid>> solids_;  // null: its elements tell
  std::vector<std::vector<Element>> elements_;
};

}  // namespace sdf_ccd
