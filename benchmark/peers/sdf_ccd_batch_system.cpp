#include "sdf_ccd/segments.h"

#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// This package's query of many segments per call.
class BatchQuery : public SegmentSystem {
 public:
  BatchQuery(const std::string& name, const DistanceField& field) : name_(name), field_(field) {}

  std::string name() const override { return name_; }
  bool answers(const Question& question) const override { return std::abs(question.sigma) <= field_.band(); }
  std::size_t bytes() const override { return field_.bytes(); }
  bool batched() const override { return true; }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    SegmentOptions options;
    options.sigma = question.sigma;
    options.mode = question.find == Find::kFirst ? SegmentMode::kFirst
                   : question.find == Find::kAll ? SegmentMode::kAll
                                                 : SegmentMode::kAny;
    segmentIntervals(field_, segments, count, options, result_);
    if (question.find != Find::kAll) return long(result_.hits.size());
    long crossings = 0;
    for (const SegmentHit& hit : result_.hits) crossings += (hit.enter > 0.0F) + (hit.exit < 1.0F);
    return crossings;
  }

 private:
  std::string name_;
  DistanceField field_;
  BatchResult result_;
};

const Registered kBatch{FieldFactory([](const FieldSubject& subject, SegmentSystems& systems) {
  systems.push_back(std::make_unique<BatchQuery>("sdf_ccd_batch", subject.field));
})};

}  // namespace
}  // namespace sdf_ccd::benchmark
