#pragma once

#include "precision/studies.h"

namespace sdf_ccd::benchmark {

/// Time of impact of two moving bodies as a monitor's cycle finds it, over `max_error` and over the accuracy of
/// contacts, compared with the meshes' own by conservative advancement with FCL's distances. Lengths are of the bodies'
/// travel [m].
precision::StudyResult impactStudy(const precision::StudyInput& input);

}  // namespace sdf_ccd::benchmark
