#include "build_systems.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::benchmark {
namespace {

std::shared_ptr<const BuiltField> build(const TriangleMesh& mesh, const StudyField& wanted) {
  const DistanceField field = buildField(mesh, wanted.options);
  return std::make_shared<const BuiltField>(
      BuiltField{field.bytes(), [field](const Vector3d& p) { return field.sample(p).value; }, field.band(), true,
                 [field](const std::string& path) { saveField(field, path); }});
}

void load(const std::string& path, const Vector3d& p) {
  const DistanceField field = loadField(path);
  segmentIntervals(field, {p, field.surfaceBox().center()});
}

const RegisteredBuilder kBuilder{{"sdf_ccd", [](const StudyField&) { return true; }, build, load}};

}  // namespace
}  // namespace sdf_ccd::benchmark
