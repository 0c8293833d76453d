#include "paper/segment_walk.h"
#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// The paper's method; the uniform and the octree traversal share one grid.
class PaperSystem : public SegmentSystem {
 public:
  PaperSystem(std::shared_ptr<const DenseField> field, std::unique_ptr<const MinMaxOctree> octree)
      : field_(std::move(field)), octree_(std::move(octree)) {}

  std::string name() const override { return octree_ ? "paper_octree" : "paper_uniform"; }
  bool answers(const Question&) const override { return true; }
  std::size_t bytes() const override { return field_->bytes() + (octree_ ? octree_->bytes() : 0); }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    const bool all = question.find == Find::kAll;
    long answers = 0;
    for (std::size_t i = 0; i < count; ++i) {
      paperIntervals(*field_, octree_.get(), segments[i], question.sigma, !all, times_);
      if (!all) answers += !times_.empty();
      if (all) {
        for (const double t : times_) answers += t > 0.0 && t < 1.0;
      }
    }
    return answers;
  }

 private:
  std::shared_ptr<const DenseField> field_;
  std::unique_ptr<const MinMaxOctree> octree_;
  std::vector<double> times_;
};

const Registered kPaper{FieldFactory([](const FieldSubject& subject, SegmentSystems& systems) {
  if (subject.cells == 0 || !subject.paper) return;
  auto field = std::make_shared<DenseField>(sampleDensely(subject.field, subject.cells));
  auto octree = std::make_unique<MinMaxOctree>(buildOctree(*field));
  systems.push_back(std::make_unique<PaperSystem>(field, nullptr));
  systems.push_back(std::make_unique<PaperSystem>(field, std::move(octree)));
})};

}  // namespace
}  // namespace sdf_ccd::benchmark
