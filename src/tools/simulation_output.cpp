#include "simulation_output.h"

#include <cmath>

#include <fmt/format.h>

#ifdef SDF_CCD_WITH_ROS
#include "ros/bag/simulation_bag.h"
#endif

namespace sdf_ccd::tools {

#ifdef SDF_CCD_WITH_ROS
struct SimulationOutput::Bag {
  Bag(const std::string& path, const SimulationSetup& setup)
      : path(path), writer(this->path.part(), path), bag(writer, setup) {}
  void add(const Simulation& simulation) { bag.add(simulation.last().time, simulation.states()); }
  void close() { writer.close(); }
  void commit() { path.commit(); }

  OutputPath path;
  BagWriter writer;
  SimulationBag bag;
};
#else
struct SimulationOutput::Bag {
  Bag(const std::string&, const SimulationSetup&) {}
  void add(const Simulation&) {}
  void close() {}
  void commit() {}
};
#endif

SimulationOutput::SimulationOutput(const std::string& directory, const SimulationSetup& setup, double frames)
    : directory_(directory),
      steps_(directory_.file("steps.csv")),
      poses_(directory_.file("poses.csv")),
      summary_(directory_.file("summary.txt")),
      bag_(std::make_unique<Bag>(directory_.file("simulation.bag"), setup)),
      frames_(frames) {
  steps_.stream() << "step,time,kinetic,potential,elastic,energy,px,py,pz,lx,ly,lz,reaction_error,deepest,contacts,"
                     "solves,run_time\n";
  poses_.stream() << "time,body,x,y,z,qx,qy,qz,qw\n";
}

SimulationOutput::~SimulationOutput() = default;

void SimulationOutput::add(const Simulation& simulation) {
  writeStep(simulation.last());
  // The tolerance keeps a frame whose time is rounded down.
  if (simulation.last().time * frames_ < double(frame_) - 1e-6) return;
  writePoses(simulation);
  bag_->add(simulation);
  frame_ = long(std::floor(simulation.last().time * frames_ + 1e-6)) + 1;
}

void SimulationOutput::commit(const std::string& summary) {
  summary_.stream() << summary;
  bag_->close();
  for (OutputFile* file : {&steps_, &poses_, &summary_}) file->close();
  for (OutputFile* file : {&steps_, &poses_, &summary_}) file->commit();
  bag_->commit();
}

void SimulationOutput::writeStep(const StepRecord& r) {
  const Vector3d& p = r.momentum.force;
  const Vector3d& L = r.momentum.torque;
  steps_.stream() << fmt::format(
      "{},{:.9g},{:.12g},{:.12g},{:.12g},{:.12g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.3g},{:.9g},{},{},{:.6g}"
      "\n",
      r.step, r.time, r.kinetic, r.potential, r.elastic, r.energy(), p.x(), p.y(), p.z(), L.x(), L.y(), L.z(),
      r.reaction_error, r.deepest, r.contacts, r.solves, r.run_time);
}

void SimulationOutput::writePoses(const Simulation& simulation) {
  for (std::size_t b = 0; b < simulation.states().size(); ++b) {
    const Isometry3d& X = simulation.states()[b].X_OB;
    const Vector3d p_W = simulation.world().origin_W + X.translation();
    const Quaterniond q(X.linear());
    poses_.stream() << fmt::format("{:.9g},{},{:.15g},{:.15g},{:.15g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                                   simulation.last().time, simulation.world().bodies[b].name, p_W.x(), p_W.y(), p_W.z(),
                                   q.x(), q.y(), q.z(), q.w());
  }
}

}  // namespace sdf_ccd::tools
