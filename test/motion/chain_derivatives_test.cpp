#include "motion/chain_derivatives.h"

#include <gtest/gtest.h>

#include "oracle/random.h"

namespace sdf_ccd::chain_derivatives_test {

using test::Random;
using test::uniform;

struct Frame {
  double reach;
  DerivativeBounds angle, slide;
  bool is_inverse;
};

Frame randomFrame(Random& random) {
  const auto bounds = [&]() -> DerivativeBounds {
    if (random() % 3 == 0) return {};
    return {uniform(random, 0.0, 2.0), random() % 2 ? uniform(random, 0.0, 1.0) : 0.0,
            random() % 2 ? uniform(random, 0.0, 1.0) : 0.0};
  };
  return {uniform(random, 0.0, 1.0), bounds(), bounds(), random() % 2 == 0};
}

TEST(CarriedDerivatives, AreThoseOfTheChainFromItsOtherEnd) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Frame> frames(random() % 8);
    for (Frame& frame : frames) frame = randomFrame(random);
    const BoundingBall ball{uniform(random, 0.0, 2.0) * test::direction(random), uniform(random, 0.0, 1.0)};
    ChainDerivatives chain(ball);
    for (const Frame& frame : frames) {
      frame.is_inverse ? chain.addInverse(frame.reach, frame.angle, frame.slide)
                       : chain.addFrame(frame.reach, frame.angle, frame.slide);
    }
    CarriedDerivatives carried;
    for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame) {
      carried = frame->is_inverse ? carried.carryingInverse(frame->reach, frame->angle, frame->slide)
                                  : carried.carrying(frame->reach, frame->angle, frame->slide);
    }
    const DerivativeSeries found = carried.of(ball.center.norm() + ball.radius);
    EXPECT_NEAR(found.value, chain.distance(), 1e-12 * chain.distance());
    EXPECT_NEAR(found.first, chain.speed(), 1e-12 * chain.speed());
    EXPECT_NEAR(found.second, chain.acceleration(), 1e-12 * chain.acceleration());
    EXPECT_NEAR(found.third, chain.jerk(), 1e-12 * chain.jerk());
  }
}

}  // namespace sdf_ccd::chain_derivatives_test
