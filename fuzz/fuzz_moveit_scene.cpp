// Fuzzes MoveIt's text format of a planning scene.
#include "fuzz_input.h"
#include "robot/moveit_scene.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  fuzz::attempt([&] {
    for (const WorldObject& object : parseMoveitScene(fuzz::toText(data, size))) {
      fuzz::require(!object.name.empty() && !object.shapes.empty(), "objects have names and shapes");
      fuzz::require(object.X_frame_B.matrix().allFinite(), "poses are finite");
    }
  });
  return 0;
}
