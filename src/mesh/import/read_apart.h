#pragma once

#include <string>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Content of a mesh or OctoMap file.
struct ReadMesh {
  TriangleMesh mesh;        ///< valid: finite, and with indices in range
  double resolution = 0.0;  ///< voxel size of an OctoMap [m]
};

/// Parses a file's content in a separate, confined process (the program sdf_ccd_read), within the limits of limitsOf().
/// A crash of that process, or an invalid answer, becomes an exception.
/// @param format  the ending of a mesh's file name, or `octomap`.
/// @throws std::runtime_error with the reason, without the file's name; Cancelled.
ReadMesh readSandboxed(const std::string& format, const std::string& bytes);

}  // namespace sdf_ccd
