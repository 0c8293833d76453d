#include "sdf_ccd/segments.h"
#include "shell_system.h"

namespace sdf_ccd::benchmark {
namespace {

ChordPath straight(const PosePair& pair) {
  return {{{0.0, 1.0, pair.X_FP_start, pair.X_FP_end, 0}}, 0.0};
}

/// Queries every point of the shell in one batch, with the query that the tree uses for the remaining points.
class Linear : public ShellSystem {
 public:
  explicit Linear(const ShellSubject& subject) : subject_(subject) {}

  std::string name() const override { return "linear"; }

  ShellAnswer run(const PosePair* pairs, std::size_t count) override {
    ShellAnswer answer;
    for (std::size_t i = 0; i < count; ++i) {
      segments_.clear();
      for (std::size_t k = 0; k < subject_.shell.size(); ++k) {
        const Vector3d p = subject_.shell.point(k);
        segments_.push_back({pairs[i].X_FP_start * p, pairs[i].X_FP_end * p});
      }
      segmentIntervals(subject_.field, segments_.data(), segments_.size(), {0.0, SegmentMode::kAll}, found_);
      answer.contacts += long(found_.hits.size());
      answer.pairs_in_contact += !found_.hits.empty();
    }
    return answer;
  }

 private:
  ShellSubject subject_;
  std::vector<Segment> segments_;
  BatchResult found_;
};

/// Queries the shell through its sphere tree.
class Tree : public ShellSystem {
 public:
  explicit Tree(const ShellSubject& subject) : subject_(subject) {}

  std::string name() const override { return "tree"; }

  ShellAnswer run(const PosePair* pairs, std::size_t count) override {
    ShellAnswer answer;
    for (std::size_t i = 0; i < count; ++i) {
      shellIntervals(subject_.field, subject_.shell, subject_.tree, straight(pairs[i]), result_);
      answer.contacts += result_.count();
      answer.pairs_in_contact += result_.touches();
    }
    return answer;
  }

 private:
  ShellSubject subject_;
  ShellQueryResult result_;
};

const RegisteredShell kShells{[](const ShellSubject& subject, ShellSystems& systems) {
  systems.push_back(std::make_unique<Linear>(subject));
  systems.push_back(std::make_unique<Tree>(subject));
}};

}  // namespace
}  // namespace sdf_ccd::benchmark
