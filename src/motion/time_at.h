#pragma once

namespace sdf_ccd {

/// Time at `s` from 0 to 1 of a Chord or a TwoBodyMotion [s], exact at both ends.
template <class Motion>
double timeAt(const Motion& motion, double s) {
  return s == 1.0 ? motion.t_end : motion.t_start + s * (motion.t_end - motion.t_start);
}

}  // namespace sdf_ccd
