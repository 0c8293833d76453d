#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "output_file.h"
#include "resolution_options.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd::tools {

/// Makes fields and shells of meshes, writes them as NAME.field and NAME.shell and reports on each.
class FieldBuilder {
 public:
  /// @param spacing  of the shells [m]; none: two cells of the field.
  FieldBuilder(OutputDirectory& out, const ResolutionOptions& resolution, std::optional<double> spacing)
      : out_(out), resolution_(resolution), spacing_(spacing) {}

  /// A mesh of any quality: its parts are turned outward first.
  void addMesh(const std::string& name, const TriangleMesh& mesh);

  /// The boundary of whole voxels, which needs no turning and has no shell.
  void addVoxels(const std::string& name, const TriangleMesh& mesh, double voxel_size);

  void printTotals() const;

 private:
  double writeField(const std::string& name, const TriangleMesh& mesh, std::optional<double> default_cell);
  void writeShell(const std::string& name, const TriangleMesh& mesh, double spacing);

  OutputDirectory& out_;
  const ResolutionOptions& resolution_;
  std::optional<double> spacing_;
  std::size_t fields_ = 0;
  std::size_t field_bytes_ = 0;
  std::size_t shells_ = 0;
  std::size_t shell_points_ = 0;
  double seconds_ = 0.0;
};

}  // namespace sdf_ccd::tools
