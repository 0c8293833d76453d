#include "sdf_ccd/motion/chords.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sdf_ccd/geometry/number_text.h"

namespace sdf_ccd {

void cutIntoChords(const RelativePath& motion, const BoundingBall& ball, const ChordOptions& options, ChordPath& path) {
  if (motion.times.size() < 2 || motion.times.size() != motion.X_FP.size()) {
    throw std::invalid_argument("relative path: " + std::to_string(motion.times.size()) + " times and " +
                                std::to_string(motion.X_FP.size()) + " poses");
  }
  if (!(options.tolerance > 0.0) || options.max_chords < 1) {
    throw std::invalid_argument("chord options: tolerance " + numberText(options.tolerance) + ", max_chords " +
                                std::to_string(options.max_chords));
  }
  path.chords.clear();
  path.error = 0.0;
  for (std::size_t k = 0; k + 1 < motion.times.size(); ++k) {
    const double t0 = motion.times[k], t1 = motion.times[k + 1];
    if (!std::isfinite(t0) || !std::isfinite(t1) || t1 <= t0) {
      throw std::invalid_argument("relative path: times " + numberText(t0) + " and " + numberText(t1) +
                                  " do not increase");
    }
    const ScrewMotion screw(motion.X_FP[k], motion.X_FP[k + 1]);
    const double acceleration = screw.maxAcceleration(ball);
    const double wanted = std::ceil(std::sqrt(acceleration / (8.0 * options.tolerance)));
    const int n = static_cast<int>(std::clamp(wanted, 1.0, double(options.max_chords)));
    path.error = std::max(path.error, acceleration / (8.0 * n * n));
    for (int i = 0; i < n; ++i) {
      const double s0 = double(i) / n, s1 = double(i + 1) / n;
      path.chords.push_back({t0 + s0 * (t1 - t0), i + 1 == n ? t1 : t0 + s1 * (t1 - t0),
                             i == 0 ? screw.start() : path.chords.back().X_FP_end, screw.pose(s1),
                             static_cast<int>(k)});
    }
  }
}

}  // namespace sdf_ccd
