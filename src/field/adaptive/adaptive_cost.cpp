#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "adaptive_shape.h"
#include "block_builder.h"
#include "common/lattice.h"
#include "common/processor_time.h"
#include "field/field_cost.h"
#include "field/sample_mean.h"
#include "field/spread_order.h"
#include "thinned_cells.h"

namespace sdf_ccd {
namespace {

/// Blocks of similar expected cost, and the results of those that were built.
struct Stratum {
  std::vector<std::size_t> blocks;
  SampleMean bytes, seconds;

  double size() const { return double(blocks.size()); }
  std::size_t built() const { return bytes.count(); }
};

/// An estimated sum over all blocks near the surface, and its variance.
struct Sum {
  double value = 0.0, variance = 0.0;

  double relativeError() const { return value > 0.0 ? std::sqrt(variance) / value : 1.0; }
};

class BlockSample {
 public:
  BlockSample(const SurfaceIndex& surface, const AdaptiveShape& shape)
      : surface_(surface),
        shape_(shape),
        builder_(surface, shape),
        blocks_(builder_.blocks()),
        order_(builder_.count()) {}

  FieldCost run() {
    markBlocks();
    const double start = threadSeconds();
    findNear(start);
    const double found = threadSeconds();
    buildNear();
    buildFar();
    const double all = double(order_.size()), tested = double(tested_), scale = all / tested;
    const double near = tested - double(far_.size());
    const double share_error = tested_ < order_.size() ? std::sqrt((1.0 - near / tested) / std::max(near, 1.0)) : 0.0;
    const Sum bytes = sum(&Stratum::bytes), seconds = sum(&Stratum::seconds);
    const double far_seconds = double(far_.size()) * far_seconds_.mean();
    FieldCost cost;
    cost.bytes = scale * bytes.value;
    cost.seconds = scale * (seconds.value + far_seconds + (found - start));
    cost.bytes_error = std::hypot(bytes.relativeError(), share_error);
    cost.seconds_error = std::hypot(seconds.relativeError(), share_error) * scale * seconds.value / cost.seconds;
    return cost;
  }

 private:
  static constexpr std::size_t kMin = 6;  ///< minimum number of built blocks of a stratum

  enum Kind : std::uint8_t { kPlain, kVertices, kDoubtful };

  void build(std::size_t i, CellTaker& taker) const {
    const Vector3i block = builder_.block(i);
    builder_.build(block, surface_.exact().nearest(builder_.center(block)), taker);
  }

  void mark(const AlignedBox3d& box, Kind kind) {
    const auto blockOf = [&](const Vector3d& p) -> Vector3i {
      return ((p - shape_.origin) / builder_.side()).array().floor().cast<int>().max(0).min(blocks_.array() - 1);
    };
    forEachPoint(blockOf(box.min()), blockOf(box.max()) + Vector3i::Ones(), [&](const Vector3i& block) {
      Kind& of = kinds_[indexIn(blocks_, block)];
      of = std::max(of, kind);
    });
  }

  /// Cells divide most where triangles do not determine the sign, and more near vertices, where the surface
  /// bends, than elsewhere.
  void markBlocks() {
    kinds_.assign(order_.size(), kPlain);
    const Solid& solid = surface_.exact().solid();
    const TriangleMesh& mesh = solid.boundary();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      AlignedBox3d box;
      for (int k = 0; k < 3; ++k) {
        const Vector3d& vertex = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
        mark({vertex, vertex}, kVertices);
        box.extend(vertex);
      }
      if (!solid.separates()[t]) mark(box, kDoubtful);
    }
  }

  /// Finds which blocks are near the surface, within a time limit.
  void findNear(double start) {
    constexpr double kSeconds = 5e-3;
    constexpr std::size_t kMin = 64, kChecked = 16;
    for (; tested_ < order_.size(); ++tested_) {
      if (tested_ >= kMin && tested_ % kChecked == 0 && threadSeconds() - start > kSeconds) break;
      const std::size_t i = order_[tested_];
      const bool far =
          builder_.isFar(surface_.exact().tree().closestPoint(builder_.center(builder_.block(i))).distance);
      (far ? far_ : strata_[kinds_[i]].blocks).push_back(i);
    }
  }

  Sum sum(SampleMean Stratum::*quantity) const {
    Sum sum;
    for (const Stratum& stratum : strata_) {
      const SampleMean& mean = stratum.*quantity;
      sum.value += stratum.size() * mean.mean();
      if (mean.count() > 0) sum.variance += stratum.size() * stratum.size() * variance(mean) / double(mean.count());
    }
    return sum;
  }

  /// The variance in a stratum: until kMin blocks are built, at least that of an exponential distribution, as most
  /// blocks cost little and a few cost much.
  static double variance(const SampleMean& mean) {
    return mean.count() < kMin ? std::max(mean.variance(), mean.mean() * mean.mean()) : mean.variance();
  }

  /// Of the strata with fewer than kMin built blocks, the one to build the next block of: first each gets two, then
  /// numbers are in proportion to the square root of the stratum's size. Null if there is none.
  Stratum* nextOfFew() {
    Stratum* best = nullptr;
    double least = 0.0;
    for (Stratum& stratum : strata_) {
      if (stratum.blocks.empty() || stratum.built() >= kMin) continue;
      const double has =
          stratum.built() < 2 ? -2.0 + double(stratum.built()) : double(stratum.built()) / std::sqrt(stratum.size());
      if (best && has >= least) continue;
      best = &stratum;
      least = has;
    }
    return best;
  }

  /// The stratum where the next block reduces the squared errors of both sums most; null if none would.
  Stratum* next(const Sum& bytes, const Sum& seconds) {
    if (Stratum* const stratum = nextOfFew()) return stratum;
    Stratum* best = nullptr;
    double most = 0.0;
    for (Stratum& stratum : strata_) {
      if (stratum.blocks.empty()) continue;
      const double weight = stratum.size() / double(stratum.built() + 1);
      const double gain = weight * weight *
                          (stratum.bytes.variance() / std::max(bytes.value * bytes.value, 1.0) +
                           stratum.seconds.variance() / (seconds.value * seconds.value));
      if (gain <= most) continue;
      best = &stratum;
      most = gain;
    }
    return best;
  }

  /// Whether the surface lies in few blocks, with long lists of triangles.
  bool isDense(double near) const {
    constexpr double kFewBlocks = 64.0, kTriangles = 64.0;
    const auto triangles = double(surface_.exact().solid().boundary().triangles.size());
    return near < kFewBlocks && triangles > kTriangles * near;
  }

  /// Builds blocks until the estimate is accurate or the time is used up. In a stratum of few blocks they are visited
  /// again, for other cells. As long as a stratum has fewer than kMin built blocks the estimated error does not end
  /// the loop: the estimate is too small if the few blocks that take long have not been visited.
  void buildNear() {
    constexpr double kSecondsForFew = 40e-3, kSeconds = 15e-3, kShare = 0.03, kSure = 0.07, kUnsure = 0.15;
    const double scale = double(order_.size()) / double(tested_), start = threadSeconds();
    std::size_t near = 0;
    for (const Stratum& stratum : strata_) near += stratum.blocks.size();
    ThinnedCells cells(isDense(scale * double(near)) ? ThinnedCells::kFewer : ThinnedCells::kMore);
    for (;;) {
      const Sum bytes = sum(&Stratum::bytes), seconds = sum(&Stratum::seconds);
      Stratum* const stratum = next(bytes, seconds);
      if (!stratum) return;
      const bool few = stratum->built() < kMin;
      const double error = std::max(bytes.relativeError(), seconds.relativeError());
      if (stratum->built() > 0) {
        const double all = scale * seconds.value;
        double least = kSecondsForFew;
        if (!few) least = error > kUnsure ? std::min(kSecondsForFew, 0.4 * all) : std::min(kSeconds, 0.2 * all);
        if (threadSeconds() - start > std::max(kShare * all, least)) return;
      }
      if (!few && error < kSure) return;
      const SpreadOrder order(stratum->blocks.size());
      const std::size_t i = stratum->blocks[order[stratum->built()]];
      cells.start();
      build(i, cells);
      const ThinnedCells::Counted counted = cells.stop();
      stratum->bytes.add(counted.bytes);
      stratum->seconds.add(counted.seconds);
    }
  }

  void buildFar() {
    constexpr std::size_t kMaxSamples = 64;
    ThinnedCells cells;
    for (std::size_t k = 0; k < std::min(far_.size(), kMaxSamples); ++k) {
      cells.start();
      build(far_[k], cells);
      far_seconds_.add(cells.stop().seconds);
    }
  }

  const SurfaceIndex& surface_;
  const AdaptiveShape& shape_;
  const BlockBuilder builder_;
  const Vector3i blocks_;
  const SpreadOrder order_;
  std::vector<Kind> kinds_;  ///< per block
  std::size_t tested_ = 0;   ///< number of blocks tested; these are:
  std::array<Stratum, 3> strata_;
  std::vector<std::size_t> far_;
  SampleMean far_seconds_;
};

}  // namespace

FieldCost expectedAdaptive(const Solid& solid, const FieldOptions& options) {
  const AdaptiveShape shape = adaptiveShape(boundingBox(solid.boundary()), options);
  const double start = threadSeconds();
  const SurfaceIndex surface(solid);
  const double indexed = threadSeconds() - start;
  FieldCost cost = BlockSample(surface, shape).run();
  cost.bytes += double(sizeof(std::uint32_t)) * double(shape.count());
  cost.seconds += indexed;
  return cost;
}

}  // namespace sdf_ccd
