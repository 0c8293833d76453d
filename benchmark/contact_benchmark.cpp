/// Time of a cycle of one pair in contact: deep, as in a robot whose shapes overlap, touching, or above the ground.
/// Compared with FCL's contacts at the cycle's end. Prints rows of results.csv.
#include <cmath>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "fcl_model.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr std::size_t kCycles = 256;  // of 10 ms, after which the motion begins again

struct Case {
  std::string name;
  test::Shape a, b;
  double distance;  // of the frames, along `axis` [m]
  Vector3d axis;
};

std::vector<Case> cases() {
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
  const Primitive ball = Sphere{0.1}, post = Cylinder::fromRadiusAndLength(0.06, 0.4),
                  crate = Box::fromSize({0.2, 0.16, 0.1}), ground = HalfSpace{};
  const test::Shape dense = test::meshShape(test::icosphere(0.1, 4)), coarse = test::meshShape(test::icosphere(0.1, 3));
  return {{"balls/deep", ball, ball, 0.15, x},
          {"cylinders/deep", post, post, 0.08, x},
          {"boxes/deep", crate, crate, 0.15, x},
          {"ball_cylinder/deep", ball, post, 0.05, x},
          {"meshes/deep", dense, coarse, 0.15, x},
          {"meshes/touching", dense, coarse, 0.194, x},
          {"box_ground/above", ground, crate, 0.06, z},
          {"box_ground/grazing", ground, crate, 0.0503, z},
          {"box_ground/deep", ground, crate, 0.04, z},
          {"mesh_ground/above", ground, dense, 0.103, z},
          {"mesh_ground/grazing", ground, dense, 0.1003, z},
          {"mesh_ground/deep", ground, dense, 0.095, z}};
}

/// Body B swings by some tenths of a millimetre and some hundredths of a radian, and turns about the axis.
std::vector<CycleMotion> motionOf(const Case& each) {
  const auto poseAt = [&](std::size_t cycle) {
    const double phase = 2.0 * M_PI * double(cycle % kCycles) / double(kCycles);
    const Vector3d across = each.axis.unitOrthogonal();
    Isometry3d X = Isometry3d::Identity();
    X.translation() = (each.distance + 3e-4 * std::sin(phase)) * each.axis + 1e-3 * std::cos(phase) * across;
    X.linear() = (Eigen::AngleAxisd(2e-3 * std::sin(phase), across) * Eigen::AngleAxisd(phase, each.axis)).matrix();
    return X;
  };
  std::vector<CycleMotion> cycles;
  for (std::size_t i = 0; i < kCycles; ++i)
    cycles.push_back(test::cycle(0.01, {test::still(Isometry3d::Identity()), {poseAt(i), poseAt(i + 1)}}));
  return cycles;
}

struct FclShape {
  std::shared_ptr<fcl::CollisionGeometryd> operator()(const Sphere& ball) const {
    return std::make_shared<fcl::Sphered>(ball.radius);
  }
  std::shared_ptr<fcl::CollisionGeometryd> operator()(const Box& box) const {
    return std::make_shared<fcl::Boxd>(box.size);
  }
  std::shared_ptr<fcl::CollisionGeometryd> operator()(const Cylinder& cylinder) const {
    return std::make_shared<fcl::Cylinderd>(cylinder.radius, cylinder.length);
  }
  std::shared_ptr<fcl::CollisionGeometryd> operator()(const HalfSpace& plane) const {
    return std::make_shared<fcl::Halfspaced>(plane.normal, plane.offset);
  }
};

std::shared_ptr<fcl::CollisionGeometryd> fclShape(const test::Shape& shape) {
  if (const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&shape)) return fclModel(**mesh);
  return std::visit(FclShape(), std::get<Primitive>(shape));
}

void study(const Case& each, const StudyOptions& options) {
  const std::vector<CycleMotion> cycles = motionOf(each);
  BodyOptions prepared = optionsForContacts();
  const auto scene = test::build({test::body("a", each.a), test::body("b", each.b)}, prepared);

  struct System {
    std::string name;
    CycleRequest request;
    std::unique_ptr<Monitor> monitor;
  };
  std::vector<System> all;
  for (const char* name : {"verdict", "contacts", "wrenches"}) {
    System system{name, {}, std::make_unique<Monitor>(scene, MonitorOptions())};
    system.request.contacts = system.name != "verdict";
    system.request.wrenches = system.name == "wrenches";
    all.push_back(std::move(system));
  }
  double contact = 0.0, uncertain = 0.0;
  for (const CycleMotion& cycle : cycles) {
    const Verdict verdict = all[0].monitor->run(cycle, all[0].request).pairs[0].verdict;
    contact += verdict == Verdict::kContact;
    uncertain += verdict == Verdict::kUncertain;
  }
  std::vector<Task> tasks;
  for (const System& system : all)
    tasks.push_back({system.name, [&](std::size_t i) {
                       system.monitor->run(cycles[i % kCycles], system.request);
                       return std::size_t{1};
                     }});
  const auto fcl_a = fclShape(each.a), fcl_b = fclShape(each.b);
  tasks.push_back({"fcl", [&](std::size_t i) {
                     fcl::CollisionResultd found;
                     fcl::CollisionRequestd request(1000, true);
                     fcl::collide(fcl_a.get(), Isometry3d::Identity(), fcl_b.get(), cycles[i % kCycles].X_WB[1].back(),
                                  request, found);
                     return std::size_t{1};
                   }});
  const std::vector<Spread> spreads = measure(tasks, options.measure);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    print({"contact", each.name, tasks[k].system, "us_per_cycle", 0.0, "us", options.measure.runs}, spreads[k], 1e6);
  print({"contact", each.name, "verdict", "contact", contact / kCycles, "of cycles", 1});
  print({"contact", each.name, "verdict", "uncertain", uncertain / kCycles, "of cycles", 1});
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full, quick;
  quick.measure.runs = 3;
  return runStudy(argc, argv, "Time of a cycle of one pair in contact, by what is requested", full, quick,
                  [](const StudyOptions& options) {
                    for (const Case& each : cases())
                      if (isWanted(options.cases, each.name)) study(each, options);
                  });
}
