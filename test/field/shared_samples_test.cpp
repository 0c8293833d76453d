#include "field/uniform/shared_samples.h"

#include <gtest/gtest.h>

#include "oracle/random.h"

namespace sdf_ccd::shared_samples_test {

/// A number for each point of the grid's lattice.
std::int16_t valueAt(const Vector3i& brick, const Vector3i& local) {
  const Vector3i p = GridShape::kBrick * brick + local;
  return static_cast<std::int16_t>(p.x() + 30 * (p.y() + 30 * p.z()));
}

TEST(SharedSamples, EachIsComputedOnceAndCopied) {
  GridShape shape;
  shape.bricks = {3, 2, 3};
  test::Random random(1);
  for (int run = 0; run < 20; ++run) {
    std::vector<std::int32_t> slots(shape.brickCount(), SparseGrid::kFar);
    std::vector<Vector3i> sampled;
    forEachPoint(shape.bricks, [&](const Vector3i& brick) {
      if (test::uniform(random, 0.0, 1.0) < 0.3) return;
      slots[shape.brickIndex(brick)] = static_cast<std::int32_t>(sampled.size());
      sampled.push_back(brick);
    });
    std::vector<std::int16_t> samples(sampled.size() * GridShape::kSamples, -1);
    std::vector<int> computed(30 * 30 * 30, 0);
    const auto forEachSample = [&](const auto& visit) {
      for (std::size_t slot = 0; slot < sampled.size(); ++slot)
        forEachPoint(GridShape::sides(), [&](const Vector3i& local) {
          const auto i = static_cast<std::size_t>(GridShape::sampleIndex(local));
          visit(sampled[slot], i, samples[slot * GridShape::kSamples + i], valueAt(sampled[slot], local));
        });
    };
    forEachSample([&](const Vector3i& brick, std::size_t i, std::int16_t& sample, std::int16_t value) {
      if (!SharedSamples(shape, slots, brick).own()[i]) return;
      sample = value;
      ++computed[static_cast<std::size_t>(value)];
    });
    for (const Vector3i& brick : sampled) SharedSamples(shape, slots, brick).copy(samples);
    forEachSample([&](const Vector3i&, std::size_t, std::int16_t sample, std::int16_t value) {
      EXPECT_EQ(sample, value);
      EXPECT_EQ(computed[static_cast<std::size_t>(value)], 1);
    });
  }
}

}  // namespace sdf_ccd::shared_samples_test
