#include "robot_case.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "robot/joint_kind.h"
#include "scene/error_budget.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::benchmark {
namespace {

std::string read(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file + ": cannot be read");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

Robot loadRobot(const std::string& argument) {
  const std::size_t equals = argument.find('='), comma = argument.find(',', equals);
  if (equals == std::string::npos) throw std::invalid_argument("--robot " + argument + ": NAME=URDF[,SRDF] is wanted");
  const std::string urdf = argument.substr(equals + 1, comma == std::string::npos ? comma : comma - equals - 1);
  const Srdf srdf = comma == std::string::npos ? Srdf() : parseSrdf(read(argument.substr(comma + 1)));
  const std::string directory = urdf.substr(0, urdf.find_last_of('/') + 1);
  const PackageFinder packages = packagesFromEnvironment();
  const ResourceLoader loader = [&](const std::string& uri) { return loadLocalResource(uri, packages, directory); };
  Robot robot{argument.substr(0, equals), RobotModel(read(urdf)), {}};
  std::vector<std::string> warnings;
  robot.scene = describeRobot(robot.model, srdf, loader, {}, warnings);
  return robot;
}

bool isDriven(const urdf::Joint& joint) {
  return !joint.mimic && hasPosition(joint);
}

JointRange rangeOf(const urdf::Joint& joint) {
  const bool limited = joint.type != urdf::Joint::CONTINUOUS && joint.limits;
  if (!limited) return {-3.14, 3.14};
  return {joint.limits->lower, joint.limits->upper};
}

JointPositions randomPositions(const RobotModel& robot, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  JointPositions positions;
  for (const auto& [name, joint] : robot.urdf().joints_) {
    if (!isDriven(*joint)) continue;
    const JointRange range = rangeOf(*joint);
    positions[name] = range.low + (range.high - range.low) * uniform(random);
  }
  return positions;
}

BodyDescription randomBox(const Robot& robot, int number, test::Random& random) {
  BodyDescription box;
  box.name = "box" + std::to_string(number);
  box.frame = robot.model.root();
  box.is_world = true;
  GeometryDescription& shape = box.geometry.emplace_back();
  const auto half = [&] { return test::uniform(random, 0.03, 0.15); };
  shape.shape = Primitive(Box::fromSize({2.0 * half(), 2.0 * half(), 2.0 * half()}));
  shape.source = "box";
  return box;
}

BodyOptions preparedAsMonitored(const MonitorOptions& monitor) {
  BodyOptions options = optionsForContacts();
  options.motion_margin = ErrorBudget::kChords * monitor.chords.tolerance;
  return options;
}

}  // namespace sdf_ccd::benchmark
