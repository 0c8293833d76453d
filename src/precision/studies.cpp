#include "studies.h"

namespace sdf_ccd::precision {

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      {"cell", "uniform fields: time of impact and depth over the cell size", &cellStudy},
      {"max-error", "adaptive fields: time of impact and depth over the maximum error", &maxErrorStudy},
      {"spacing", "shells: force and missed depth over the spacing of the points", &spacingStudy},
      {"quadrature", "impulses: midpoint rules and the exact rule", &quadratureStudy},
      {"step", "dynamics: resting and bouncing contact over the time step, per integrator", &stepStudy},
  };
  return all;
}

}  // namespace sdf_ccd::precision
