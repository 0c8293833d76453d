#include <openvdb/io/File.h>
#include <openvdb/tools/Interpolation.h>

#include "build_systems.h"
#include "openvdb_grid.h"

namespace sdf_ccd::benchmark {
namespace {

double distance(const openvdb::FloatGrid& grid, const Vector3d& p) {
  return openvdb::tools::BoxSampler::sample(grid.tree(), grid.worldToIndex({p.x(), p.y(), p.z()}));
}

std::shared_ptr<const BuiltField> build(const TriangleMesh& mesh, const StudyField& wanted) {
  const openvdb::FloatGrid::Ptr grid = openVdbLevelSet(mesh, wanted.cells);
  return std::make_shared<const BuiltField>(
      BuiltField{grid->memUsage(), [grid](const Vector3d& p) { return distance(*grid, p); }, grid->background(), false,
                 [grid](const std::string& path) { openvdb::io::File(path).write({grid}); }});
}

void load(const std::string& path, const Vector3d& p) {
  openvdb::io::File file(path);
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(file.beginName().gridName()));
  distance(*grid, p);
}

const RegisteredBuilder kBuilder{{"openvdb", [](const StudyField& field) { return field.cells > 0; }, build, load}};

}  // namespace
}  // namespace sdf_ccd::benchmark
