#include "sdf_ccd/mesh.h"

#include <stdexcept>

#include "common/files/regular_file.h"
#include "common/shown_text.h"
#include "mesh/import/read_apart.h"

namespace sdf_ccd {

TriangleMesh parseOctomapSurface(const std::string& bytes, const std::string& name, double& resolution) {
  try {
    ReadMesh read = readSandboxed("octomap", bytes);
    resolution = read.resolution;
    return std::move(read.mesh);
  } catch (const std::exception& error) {
    throw std::runtime_error(shownText(name) + ": " + error.what());
  }
}

TriangleMesh loadOctomapSurface(const std::string& path, double& resolution) {
  return parseOctomapSurface(readNamedFile(path), path, resolution);
}

}  // namespace sdf_ccd
