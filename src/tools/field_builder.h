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

/// Orients the mesh outward. Prints warnings about its inside to stderr, prefixed by `source`.
OrientedMesh orientWithWarning(const std::string& source, const TriangleMesh& mesh);

/// Prints what was left out of a mesh's solid and what is ambiguous about it, a line each, prefixed by `indent`. Prints
/// nothing if there is neither.
void printSolid(const SolidReport& report, const std::string& indent);

/// Builds the field of a mesh from a file, with a progress bar. Prints the expected cost first if that is more than a
/// second.
/// @param made  of the mesh.
/// @throws std::length_error beyond the monitor's limits, with a setting that would fit, before anything is built.
DistanceField buildAffordable(const std::string& file, const TriangleMesh& mesh, MadeSolid& made,
                              const FieldOptions& options);

/// Builds fields and shells of meshes, writes them as NAME.field and NAME.shell and reports on each.
class FieldBuilder {
 public:
  /// @param spacing  of the shells' points [m]; if not set, 2.3 times the field's error bound: two cells of a uniform
  ///   grid.
  FieldBuilder(OutputDirectory& out, const ResolutionOptions& resolution, std::optional<double> spacing)
      : out_(out), resolution_(resolution), spacing_(spacing), cost_(spacing) {}

  /// Adds the expected cost of addMesh() or addVoxels(). A mesh that cannot be built adds no cost; addMesh() reports
  /// the reason.
  void expectMesh(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh);
  void expectVoxels(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh, double voxel_size);

  /// Prints the expected total cost if building takes more than a second.
  /// @throws std::length_error beyond the monitor's limits, with a setting that would fit.
  void requireAffordable() const { cost_.announce(); }

  /// Builds and writes the field and shell of a mesh of any quality; its components are oriented outward first.
  /// Existing files are overwritten.
  void addMesh(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh);

  /// Builds and writes the field of a voxel surface, which needs no orientation and gets no shell. The default cell is
  /// half a voxel: the field's error, √3/2 of a cell, is then less than the depth of a voxel's centre, so that no
  /// voxel is lost.
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
