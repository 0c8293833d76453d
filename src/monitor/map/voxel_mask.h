#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

struct Body;
struct BodyDescription;
struct Scene;

/// A solid whose own voxels are ignored: one of the robot's links, or an object attached to one.
struct VoxelMask {
  Vector3d center_M = Vector3d::Zero();                 ///< of a ball that contains it, in the map's frame M [m]
  double radius = 0.0;                                  ///< [m]
  std::function<double(const Vector3d& p_M)> distance;  ///< lower bound of the distance to it [m]; must be thread-safe
  /// The same to its surface alone, and exact up to `limit`, beyond which any larger distance may be returned: far from
  /// a surface `distance` may be far too low. Null if `distance` is exact itself.
  std::function<double(const Vector3d& p_M, double limit)> surface_distance;
  bool is_open = false;       ///< what is occupied inside is not ignored: a surface has openings, or may have cavities
  bool only_unknown = false;  ///< ignores only unknown voxels: when the map was made, the solid may have been elsewhere
  bool is_guess = false;      ///< but it may have been here as well: what is occupied here may be its own picture

  /// Whether it is within a limit of a point [m]; its surface alone, unless what is inside counts.
  bool isWithin(double limit, const Vector3d& p_M, bool inside_counts = true) const {
    const double bound = distance(p_M);
    if (!(bound <= limit)) return false;
    const bool is_known = inside_counts && bound <= 0.0;
    return is_known || !surface_distance || surface_distance(p_M, limit) <= limit;
  }
};

/// The part of a map that a body fills, as a mask. Empty if the body has no bounded geometry whose distance is known.
/// @param body  a mesh's surface is made here if the body has none: see needsSurface().
/// @param X_BM  pose of the map's frame in the body's. The mask refers to `body` and `description`.
std::optional<VoxelMask> maskOf(const Body& body, const BodyDescription& description, const Isometry3d& X_BM);

/// An object of the scene, whose voxels are judged as the object itself.
struct ObjectMask {
  std::string name;
  std::uint64_t declared = 0;            ///< a number that changes when a request says anew what or where the object is
  bool is_attached = false;              ///< it moves with the robot, and is checked against the map
  bool is_at_stamp = false;              ///< its pose is that at the map's stamp; else a later one
  Vector3d center_M = Vector3d::Zero();  ///< of a ball that contains it, in the map's frame M [m]
  double radius = 0.0;                   ///< [m]; infinite for half-spaces
  /// Whether a point is certainly in the object, or within a limit of it [m]. Null: it is not known where an attached
  /// object is; it has no voxels then.
  std::function<bool(const Vector3d& p_M, double limit)> isWithin;
};

/// The space that a body fills, without name. Empty if no part of it has a known distance.
/// @param X_BM  pose of the map's frame in the body's. The mask refers to `body` and `description`.
std::optional<ObjectMask> objectMaskOf(const Body& body, const BodyDescription& description, const Isometry3d& X_BM);

/// Masks of the scene's links hide voxels up to this distance, if the padding is smaller [m]: twice the fields' error,
/// within which they cannot tell the inside from the outside.
double maskError(const Scene& scene);

}  // namespace sdf_ccd
