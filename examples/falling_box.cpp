// Simulates a box that falls on the ground and comes to rest.
#include <cmath>
#include <cstdio>

#include <sdf_ccd/simulation.h>

int main() {
  using namespace sdf_ccd;
  RigidBody ground;
  ground.name = "ground";
  ground.fixed = true;
  ground.shape = makeShape(Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), {});

  const Primitive cube = Box::fromSize({0.1, 0.1, 0.1});  // [m]
  const MassProperties mass = massProperties(cube, 1000.0);
  ShellOptions points;
  points.spacing = 0.02;
  RigidBody box;
  box.name = "box";
  box.mass = mass.mass;
  box.inertia = mass.inertia;
  box.shape = makeShape(cube, points);

  RigidWorld world;
  world.bodies = {ground, box};
  BodyState start;
  start.X_OB = Eigen::Translation3d(0.0, 0.0, 0.2);
  Simulation simulation(world, {BodyState(), start}, Scheme::kImplicit, 1e-3);
  while (simulation.last().time < 1.0) simulation.advance();

  const double height = simulation.states()[1].X_OB.translation().z();
  std::printf("after %.3g s its centre is %.4g m high, %d points touch\n", simulation.last().time, height,
              simulation.last().contacts);
  return std::abs(height - 0.05) < 1e-3 ? 0 : 1;
}
