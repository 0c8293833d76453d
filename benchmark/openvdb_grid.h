#pragma once

#include <vector>

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd::benchmark {

/// OpenVDB's narrow-band level set of a mesh (three voxels to either side) with `cells` voxels along its longest side.
inline openvdb::FloatGrid::Ptr openVdbLevelSet(const TriangleMesh& mesh, int cells) {
  openvdb::initialize();
  std::vector<openvdb::Vec3s> points;
  for (const Vector3d& v : mesh.vertices) points.emplace_back(float(v.x()), float(v.y()), float(v.z()));
  std::vector<openvdb::Vec3I> triangles;
  for (const Vector3i& t : mesh.triangles) triangles.emplace_back(t.x(), t.y(), t.z());
  const double voxel = boundingBox(mesh).sizes().maxCoeff() / cells;
  return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*openvdb::math::Transform::createLinearTransform(voxel),
                                                            points, triangles);
}

}  // namespace sdf_ccd::benchmark
