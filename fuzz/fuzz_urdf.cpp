// Fuzzes a URDF, then computes the robot's forward kinematics and reaches.
#include "fuzz_input.h"
#include "sdf_ccd/robot.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  fuzz::attempt([&] {
    const RobotModel robot(fuzz::toText(data, size), "fuzz");
    robot.forwardKinematics({});
    for (const std::string& link : robot.links()) {
      fuzz::require(robot.reach(robot.root(), Vector3d::Zero(), link, Vector3d::Zero()) >= 0.0, "a reach is a number");
      robot.adjacent(robot.root(), link);
    }
  });
  return 0;
}
