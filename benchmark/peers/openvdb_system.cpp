#include <cmath>
#include <optional>

#include <openvdb/openvdb.h>
#include <openvdb/tools/RayIntersector.h>

#include "openvdb_grid.h"
#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// OpenVDB's intersector of rays and narrow-band level sets. First hits only; a segment that starts inside is in
/// contact where it leaves.
class OpenVdb : public SegmentSystem {
 public:
  explicit OpenVdb(openvdb::FloatGrid::Ptr grid) : grid_(std::move(grid)), intersector_(std::in_place, *grid_) {}

  std::string name() const override { return "openvdb"; }
  bool answers(const Question& question) const override {
    return question.find != Find::kAll && std::abs(question.sigma) < grid_->background() - grid_->voxelSize()[0];
  }
  std::size_t bytes() const override { return grid_->memUsage(); }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    const auto sigma = float(question.sigma);
    if (sigma != intersector_->getIsoValue()) intersector_.emplace(*grid_, sigma);
    const double voxel = grid_->voxelSize()[0];
    long answers = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d o = segments[i].start / voxel, d = segments[i].end / voxel - o;
      const double length = d.norm();
      const openvdb::math::Ray<double> ray({o.x(), o.y(), o.z()}, {d.x() / length, d.y() / length, d.z() / length},
                                           openvdb::math::Delta<double>::value(), length);
      double at = 0.0;
      openvdb::Vec3d place;
      // It steps by voxels and may report what lies just behind the end.
      answers += intersector_->intersectsIS(ray, place, at) && at <= length;
    }
    return answers;
  }

 private:
  using Intersector = openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid>;

  openvdb::FloatGrid::Ptr grid_;
  std::optional<Intersector> intersector_;
};

const Registered kOpenVdb{FieldFactory([](const FieldSubject& subject, SegmentSystems& systems) {
  if (subject.cells == 0) return;
  systems.push_back(std::make_unique<OpenVdb>(openVdbLevelSet(subject.mesh, subject.cells)));
})};

}  // namespace
}  // namespace sdf_ccd::benchmark
