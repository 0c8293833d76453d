#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// Many states of a robot's joints. The names are stored once, as an hour of joint states at 1 kHz holds millions.
struct JointStates {
  std::vector<std::string> joints;
  std::vector<std::vector<double>> positions;  ///< per state: of all joints, or of the first ones [rad or m]

  std::size_t size() const { return positions.size(); }

  JointPositions state(std::size_t i) const {
    JointPositions named;
    for (std::size_t j = 0; j < positions[i].size(); ++j) named[joints[j]] = positions[i][j];
    return named;
  }
};

}  // namespace sdf_ccd
