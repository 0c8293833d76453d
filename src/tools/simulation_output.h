#pragma once

#include <memory>
#include <string>

#include "output_file.h"
#include "sdf_ccd/simulation.h"

namespace sdf_ccd::tools {

/// The files of a run: steps.csv, poses.csv, summary.txt, and simulation.bag if built with ROS. Without commit() no
/// file is left.
class SimulationOutput {
 public:
  /// @param frames  poses per second of the simulation.
  /// @throws std::runtime_error if the directory cannot be written.
  SimulationOutput(const std::string& directory, const SimulationSetup& setup, double frames);
  ~SimulationOutput();

  /// Writes the simulation's last step, and the poses if the next frame is due.
  void add(const Simulation& simulation);

  void commit(const std::string& summary);

 private:
  struct Bag;

  void writeStep(const StepRecord& record);
  void writePoses(const Simulation& simulation);

  OutputDirectory directory_;
  OutputFile steps_, poses_, summary_;
  std::unique_ptr<Bag> bag_;
  double frames_;
  long frame_ = 0;  // index of the next frame
};

}  // namespace sdf_ccd::tools
