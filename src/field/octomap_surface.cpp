#include "sdf_ccd/field/octomap_surface.h"

#include <stdexcept>

#include "process/read_apart.h"
#include "process/regular_file.h"
#include "process/shown_text.h"

namespace sdf_ccd {

TriangleMesh loadOctomapSurface(const std::string& path, double& resolution) {
  try {
    ReadMesh read = readApart("octomap", readRegularFile(path));
    resolution = read.resolution;
    return std::move(read.mesh);
  } catch (const std::exception& error) {
    throw std::runtime_error(shownText(path) + ": " + error.what());
  }
}

}  // namespace sdf_ccd
