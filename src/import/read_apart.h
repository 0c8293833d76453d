#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// The content of a file.
struct ReadMesh {
  TriangleMesh mesh;        ///< valid: finite, and with indices in range
  double resolution = 0.0;  ///< voxel size of an OctoMap [m]
};

/// Has a file's content read by the program sdf_ccd_read, a process for each, within the limits of limitsOf(). If the
/// libraries that read it crash, that is an error here; so is an invalid answer.
/// @param format  the ending of a mesh's file name, or `octomap`.
/// @throws std::runtime_error with the reason, without a name; Cancelled.
ReadMesh readApart(const std::string& format, const std::string& bytes);

}  // namespace sdf_ccd
