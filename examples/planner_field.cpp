// A field in a planner's inner loop: finds which of many straight moves of a tool's tip do not touch an obstacle.
#include <cmath>
#include <cstdio>
#include <random>

#include <sdf_ccd/sdf_ccd.h>

int main() {
  using namespace sdf_ccd;
  constexpr double kRadius = 0.2, kTip = 0.01;  // [m]
  FieldOptions wanted;
  wanted.max_error = 5e-4;   // [m]
  wanted.band = 2.0 * kTip;  // isovalues of queries must lie within the band
  const DistanceField field = buildField(tessellate(Sphere{kRadius}, 1e-4), wanted);

  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5);
  const auto draw = [&] { return Vector3d(coordinate(random), coordinate(random), coordinate(random)); };
  std::vector<Segment> moves(10'000);
  for (Segment& move : moves) move = {draw(), draw()};

  // The tip is a ball of radius kTip: it does not touch the obstacle where its centre is farther away than kTip.
  SegmentOptions options;
  options.sigma = kTip + field.errorBound();
  options.mode = SegmentMode::kAny;
  std::size_t free = 0, wrong = 0;
  for (const Segment& move : moves) {
    const bool is_free = segmentIntervals(field, move, options).empty();
    free += is_free;
    // The exact distance to a sphere is known.
    const Vector3d displacement = move.end - move.start;
    const double t = std::min(1.0, std::max(0.0, -move.start.dot(displacement) / displacement.squaredNorm()));
    if (is_free && (move.start + t * displacement).norm() < kRadius - 1e-4 + kTip) ++wrong;
  }
  std::printf("%zu of %zu moves are free\n", free, moves.size());

  // Distance and gradient, for planners that optimise a cost of obstacles.
  const FieldValue near = field.interpolate({0.0, 0.0, 0.25});
  std::printf("0.05 m away: %.4f m, towards (%.2f %.2f %.2f)\n", near.value, near.gradient.x(), near.gradient.y(),
              near.gradient.z());
  return wrong == 0 && free > 0 && free < moves.size() && std::abs(near.value - 0.05) < 2e-3 ? 0 : 1;
}
