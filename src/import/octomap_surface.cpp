#include "sdf_ccd/import/mesh_file.h"

#include <stdexcept>

#include "common/shown_text.h"
#include "import/read_apart.h"
#include "storage/regular_file.h"

namespace sdf_ccd {

TriangleMesh loadOctomapSurface(const std::string& path, double& resolution) {
  try {
    ReadMesh read = readSandboxed("octomap", readRegularFile(path));
    resolution = read.resolution;
    return std::move(read.mesh);
  } catch (const std::exception& error) {
    throw std::runtime_error(shownText(path) + ": " + error.what());
  }
}

}  // namespace sdf_ccd
