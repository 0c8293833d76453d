#include <cmath>
#include <optional>

#include <openvdb/openvdb.h>
#include <openvdb/tools/RayIntersector.h>

#include "openvdb_grid.h"
#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// OpenVDB's ray intersector of narrow-band level sets. It finds first hits only; for a segment that starts inside,
/// that is where the segment leaves.
class OpenVdb : public SegmentSystem {
 public:
  explicit OpenVdb(openvdb::FloatGrid::Ptr grid) : grid_(std::move(grid)), intersector_(std::in_place, *grid_) {}

  std::string name() const override { return "openvdb"; }
  bool answers(const Question& question) const override {
    return question.find != Find::kAll && std::abs(question.sigma) < grid_->background() - grid_->voxelSize()[0];
  }
  std::size_t bytes() const override { return grid_->memUsage(); }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    setIsoValue(float(question.sigma));
    long answers = 0;
    for (std::size_t i = 0; i < count; ++i) answers += firstTime(segments[i]) >= 0.0;
    return answers;
  }

  bool tellsTimes() const override { return true; }
  void firstTimes(const std::vector<Segment>& segments, std::vector<double>& times) override {
    setIsoValue(0.0F);
    times.resize(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) times[i] = firstTime(segments[i]);
  }

 private:
  void setIsoValue(float sigma) {
    if (sigma != intersector_->getIsoValue()) intersector_.emplace(*grid_, sigma);
  }

  /// Parameter of the first hit; negative if there is none.
  double firstTime(const Segment& segment) {
    const double voxel = grid_->voxelSize()[0];
    const Vector3d o = segment.start / voxel, d = segment.end / voxel - o;
    const double length = d.norm();
    const openvdb::math::Ray<double> ray({o.x(), o.y(), o.z()}, {d.x() / length, d.y() / length, d.z() / length},
                                         openvdb::math::Delta<double>::value(), length);
    double at = 0.0;
    openvdb::Vec3d place;
    // It steps by voxels and may report a hit just behind the segment's end.
    return intersector_->intersectsIS(ray, place, at) && at <= length ? at / length : -1.0;
  }

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
