#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "brick_sampler.h"
#include "common/lattice.h"
#include "common/processor_time.h"
#include "field/field_cost.h"
#include "field/grid_cell.h"
#include "field/sample_mean.h"
#include "field/spread_order.h"
#include "uniform_shape.h"

namespace sdf_ccd {
namespace {

class BrickSample {
 public:
  BrickSample(const Solid& solid, const GridShape& shape)
      : shape_(shape), start_(threadSeconds()), sampler_(solid, shape), prepared_(threadSeconds() - start_) {}

  FieldCost run(double bytes_per_sample) {
    findNeeded();
    measureCorners();
    measureNeeded();
    const double all = double(shape_.brickCount()), share = double(needed_.size()) / double(tested_);
    const double share_error =
        double(tested_) < all ? std::sqrt((1.0 - share) / std::max<double>(1.0, needed_.size())) : 0;
    const double coarse = double(shape_.coarseBytes());
    FieldCost cost;
    cost.bytes = coarse + share * all * GridShape::kSamples * bytes_per_sample;
    const double samples = share * all * brick_seconds_.mean();
    cost.seconds = prepared_ + double(shape_.cornerCount()) * corner_seconds_.mean() + all * test_seconds_ + samples;
    cost.bytes_error = share_error * (1.0 - coarse / cost.bytes);
    cost.seconds_error = std::hypot(brick_seconds_.relativeError(), share_error) * samples / cost.seconds;
    return cost;
  }

 private:
  double side() const { return GridShape::kBrick * shape_.cell; }

  Vector3i at(std::size_t i) const { return pointIn(shape_.bricks, i); }

  /// Finds which bricks need samples, within a time limit.
  void findNeeded() {
    constexpr double kSeconds = 5e-3;
    constexpr std::size_t kMin = 256;
    const SpreadOrder order(shape_.brickCount());
    const double reach = shape_.band + shape_.cell + kHalfSqrt3 * side(), start = threadSeconds();
    for (; tested_ < order.size(); ++tested_) {
      if (tested_ >= kMin && tested_ % 16 == 0 && threadSeconds() - start > kSeconds) break;
      const Vector3i brick = at(order[tested_]);
      const Vector3d center = shape_.origin + side() * (brick.cast<double>().array() + 0.5).matrix();
      if (sampler_.surface().tree().closestPoint(center, reach).distance < reach) needed_.push_back(brick);
    }
    test_seconds_ = (threadSeconds() - start) / double(tested_);
  }

  /// Measures the time of a distance at a brick's corner, found from that at the corner before it.
  void measureCorners() {
    constexpr std::size_t kMaxSamples = 128;
    const SpreadOrder order(shape_.brickCount());
    for (std::size_t k = 0; k < std::min(order.size(), kMaxSamples); ++k) {
      const Vector3d p = shape_.origin + side() * at(order[k]).cast<double>();
      const SignedSurface::Nearest before = sampler_.surface().nearest(p);
      const double start = threadSeconds();
      sampler_.surface().next(p + side() * Vector3d::UnitX(), before, side());
      corner_seconds_.add(threadSeconds() - start);
    }
  }

  void measureNeeded() {
    constexpr double kSeconds = 15e-3, kShareOfAll = 0.03, kSure = 0.05;
    constexpr std::size_t kMin = 8;
    std::array<float, GridShape::kSamples> samples;
    const BrickSampler::Wanted wanted = withoutUpperFaces();
    const SpreadOrder order(needed_.size());
    const double whole = double(needed_.size()) / double(tested_) * double(shape_.brickCount());
    const double start = threadSeconds();
    for (std::size_t k = 0; k < needed_.size(); ++k) {
      const double begin = threadSeconds();
      if (k >= kMin && begin - start > std::max(kSeconds, kShareOfAll * whole * brick_seconds_.mean())) break;
      if (k >= 4 * kMin && brick_seconds_.relativeError() < kSure) break;
      sampler_.fill(needed_[order[k]], wanted, samples.data());
      brick_seconds_.add(threadSeconds() - begin);
    }
  }

  /// Those that a brick computes if all around it have samples too, as most have: see SharedSamples.
  static BrickSampler::Wanted withoutUpperFaces() {
    BrickSampler::Wanted wanted;
    forEachPoint(GridShape::sides(), [&](const Vector3i& local) {
      wanted[std::size_t(GridShape::sampleIndex(local))] = local.maxCoeff() < GridShape::kBrick;
    });
    return wanted;
  }

  const GridShape shape_;
  const double start_;
  const BrickSampler sampler_;
  const double prepared_;  ///< [s]
  std::size_t tested_ = 0;
  double test_seconds_ = 0.0;  ///< for each brick
  std::vector<Vector3i> needed_;
  SampleMean corner_seconds_, brick_seconds_;
};

}  // namespace

FieldCost expectedUniform(const Solid& solid, const FieldOptions& options) {
  const GridShape shape = uniformShape(boundingBox(solid.boundary()), options);
  return BrickSample(solid, shape).run(double(sizeof(std::int16_t)));
}

}  // namespace sdf_ccd
