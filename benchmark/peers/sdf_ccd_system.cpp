#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// This package's query of one segment per call.
class SingleQuery : public SegmentSystem {
 public:
  SingleQuery(const std::string& name, const DistanceField& field) : name_(name), field_(field) {}

  std::string name() const override { return name_; }
  bool answers(const Question& question) const override { return std::abs(question.sigma) <= field_.band(); }
  std::size_t bytes() const override { return field_.bytes(); }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    const bool all = question.find == Find::kAll;
    const SegmentOptions options{question.sigma, all ? SegmentMode::kAll : SegmentMode::kFirst};
    long answers = 0;
    for (std::size_t i = 0; i < count; ++i) {
      segmentIntervals(field_, segments[i], options, intervals_);
      if (!all) answers += !intervals_.empty();
      if (all) {
        for (const Interval& interval : intervals_) answers += (interval.enter > 0.0) + (interval.exit < 1.0);
      }
    }
    return answers;
  }

 private:
  std::string name_;
  DistanceField field_;
  Intervals intervals_;
};

const Registered kSingle{FieldFactory([](const FieldSubject& subject, SegmentSystems& systems) {
  systems.push_back(std::make_unique<SingleQuery>("sdf_ccd", subject.field));
})};

}  // namespace
}  // namespace sdf_ccd::benchmark
