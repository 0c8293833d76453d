#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "build_cost.h"
#include "geometry/solid_boundary.h"
#include "output_file.h"
#include "resolution_options.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd::tools {

/// The mesh turned outward; what must be known of its inside is said on stderr, `source` in front.
OrientedMesh orientWithWarning(const std::string& source, const TriangleMesh& mesh);

/// What was left out of a mesh's solid and what is doubtful about it, in a line each that begins with `indent`; nothing
/// if nothing was.
void printSolid(const SolidReport& report, const std::string& indent);

/// The field of a solid with a progress bar of that title.
DistanceField buildWithBar(const std::string& title, const Solid& solid, const FieldOptions& options);
DistanceField buildWithBar(const std::string& title, const SolidSource& source, const FieldOptions& options);

/// Makes fields and shells of meshes, writes them as NAME.field and NAME.shell and reports on each.
class FieldBuilder {
 public:
  /// @param spacing  of the shells [m]; none: 2.3 times the field's error bound, two cells of a uniform grid.
  FieldBuilder(OutputDirectory& out, const ResolutionOptions& resolution, std::optional<double> spacing)
      : out_(out), resolution_(resolution), spacing_(spacing), cost_(spacing) {}

  /// Expects what addMesh() or addVoxels() will take. A mesh that cannot be made ready costs nothing; adding it says
  /// why.
  void expectMesh(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh);
  void expectVoxels(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh, double voxel_size);

  /// Says what is expected of all, if it takes more than a second.
  /// @throws std::length_error beyond the limits that the monitor has, with what would fit.
  void requireAffordable() const;

  /// A mesh of any quality: its parts are turned outward first. What was made of it before is written again.
  void addMesh(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh);

  /// The boundary of whole voxels, which needs no turning and has no shell. The default cell is half a voxel: the
  /// field's error, √3/2 of a cell, is then less than the depth of a single voxel's middle, so that none is lost.
  void addVoxels(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh, double voxel_size);

  void printTotals() const;

 private:
  struct Made {
    DistanceField field;
    PointShell shell;
    std::string quality;
    SolidReport solid;
    double field_seconds;
    double shell_seconds;
  };

  PooledMesh& find(const std::shared_ptr<const TriangleMesh>& mesh, bool voxels);
  Made make(const std::string& name, PooledMesh& mesh);
  void writeField(const std::string& name, const DistanceField& field, const std::string& time);
  void writeShell(const std::string& name, const PointShell& shell, const std::string& time);

  OutputDirectory& out_;
  const ResolutionOptions& resolution_;
  std::optional<double> spacing_;
  BuildCost cost_;
  MeshPool pool_{BodyOptions()};
  std::set<const PooledMesh*> expected_;
  std::map<const PooledMesh*, Made> made_;
  std::size_t fields_ = 0;
  std::size_t field_bytes_ = 0;
  std::size_t shells_ = 0;
  std::size_t shell_points_ = 0;
  double seconds_ = 0.0;
};

}  // namespace sdf_ccd::tools
