// Fuzzes the sections of a shell file, then builds the sphere tree of its points.
#include <cmath>

#include "oracle/file_versions.h"
#include "shell/point_shell.h"
#include "valid_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static const fuzz::InputFile file(".shell");
  fuzz::attempt([&] {
    fuzz::writeWithChecksum(data, size, file, "shell", test::kShellVersion);
    PointShell shell = loadShell(file.path());
    const SphereTree tree = buildSphereTree(shell);
    for (const SphereTree::Node& node : tree.nodes) {
      fuzz::require(node.center.allFinite() && std::isfinite(node.radius), "spheres are finite");
      fuzz::require(0 <= node.begin && node.begin <= node.end && node.end <= int(shell.size()), "points are there");
    }
  });
  return 0;
}
