#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "commands.h"
#include "common/number_text.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "simulation_output.h"

namespace sdf_ccd::tools {
namespace {

struct SimulateArguments {
  std::string scene;
  std::string out;
  std::string integrator;
  std::optional<double> step, duration;  // [s]
  double frames = 30.0;                  // per second
};

constexpr double kUnstable = 0.1;  // growth of energy that is told, relative to the highest kinetic and elastic energy

/// Summary of a finished run.
struct Summary {
  double highest_rise = 0.0;  // of the energy from one step to the next [J]
  double moving = 0.0;        // highest kinetic and elastic energy [J]
  double deepest = 0.0;       // at a step's end [m]
  double reaction_error = 0.0;
  double energy_excess = 0.0;
  double run_time = 0.0;
  long contact_steps = 0;

  void add(const StepRecord& before, const StepRecord& now) {
    highest_rise = std::max(highest_rise, now.energy() - before.energy());
    moving = std::max(moving, now.kinetic + now.elastic);
    deepest = std::max(deepest, now.deepest);
    reaction_error = std::max(reaction_error, now.reaction_error);
    energy_excess += now.energy_excess;
    run_time += now.run_time;
    contact_steps += now.contacts > 0;
  }
};

std::string report(const SimulateArguments& arguments, const SimulationSetup& setup, const StepRecord& start,
                   const StepRecord& end, const Summary& summary) {
  std::size_t moving = 0;
  for (const RigidBody& body : setup.world.bodies) moving += !body.fixed;
  std::string text = fmt::format(
      "scene            {}\n"
      "integrator       {}, step {:g} s\n"
      "bodies           {}, of which {} move\n"
      "steps            {} ({:g} s), with contact in {}\n"
      "energy           {:.3g} J at the start, {:.3g} J at the end; kinetic {:.3g} J\n"
      "highest rise     {:.3g} J in one step\n"
      "deepest point    {:.3g} m at the end of a step\n"
      "reaction error   {:.3g} of the contact impulses\n"
      "run time         {}, {:.3g} ms a step\n",
      arguments.scene, toString(setup.scheme), setup.step, setup.world.bodies.size(), moving, end.step, end.time,
      summary.contact_steps, start.energy(), end.energy(), end.kinetic, summary.highest_rise, summary.deepest,
      summary.reaction_error, durationText(summary.run_time), 1e3 * summary.run_time / std::max(1L, end.step));
  if (summary.energy_excess > 0.0) text += fmt::format("energy excess    {:.3g} J\n", summary.energy_excess);
  if (end.energy() - start.energy() > kUnstable * summary.moving + 1e-6 * std::abs(start.energy())) {
    text += fmt::format(
        "warning          the energy grew from {:.3g} J to {:.3g} J: the integrator is not stable here; shorten the "
        "step, "
        "lower the stiffness, or use implicit\n",
        start.energy(), end.energy());
  }
  return text;
}

void run(const SimulateArguments& arguments) {
  if (!(arguments.frames > 0.0) || !std::isfinite(arguments.frames)) {
    throw std::runtime_error("--frames must be positive");
  }
  SimulationSetup setup = loadSimulation(arguments.scene);
  if (!arguments.integrator.empty()) setup.scheme = schemeOf(arguments.integrator);
  setup.step = arguments.step.value_or(setup.step);
  setup.duration = arguments.duration.value_or(setup.duration);
  for (const std::string& warning : setup.warnings) std::cerr << "sdf_ccd: " << warning << std::endl;
  Simulation simulation(setup.world, setup.states, setup.scheme, setup.step);
  const double wanted = std::ceil(setup.duration / setup.step - 1e-9);
  if (!(wanted >= 1.0) || !(wanted <= 1e9)) {
    throw std::runtime_error("duration / step must be 1 to 1e9 steps, got " + shortText(wanted));
  }
  const Interrupt interrupt;
  SimulationOutput out(arguments.out, setup, arguments.frames);
  const StepRecord start = simulation.last();
  out.add(simulation);
  Summary summary;
  std::string failure;
  ProgressBar bar("simulation");
  for (long i = 0; i < long(wanted); ++i) {
    const StepRecord before = simulation.last();
    try {
      summary.add(before, simulation.advance());
    } catch (const SimulationError& error) {
      failure = error.what();
      break;
    }
    out.add(simulation);
    bar(double(i + 1) / wanted);
    if (interrupt.requested()) {
      failure = "interrupted after step " + std::to_string(i + 1);
      break;
    }
  }
  std::string said = report(arguments, setup, start, simulation.last(), summary);
  if (!failure.empty()) said += "stopped          " + failure + "\n";
  std::cout << said << std::flush;
  out.commit(said);
  if (failure.empty()) return;
  std::cerr << "sdf_ccd: " << failure << std::endl;
  throw PartlyDone();
}

}  // namespace

void addSimulateCommand(CLI::App& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = app.add_subcommand("simulate", "Rigid bodies under the contact model");
  command->footer(
      "Writes steps.csv (per step: energies [J], momentum [N s] and angular momentum [N m s] about the scene's origin, "
      "error of action against reaction, deepest point and points in contact at the step's end [m], linear solves, run "
      "time [s]), poses.csv, summary.txt, and, built with ROS, simulation.bag for rviz. A point may have been deeper "
      "between two ends. A run that cannot go on says which body stopped it, at which step and why, keeps what it has, "
      "and exits with 1; so does one that is interrupted (Ctrl-C).");
  command->add_option("scene", arguments->scene, "YAML file, as those in config/scenes")->required();
  command->add_option("--out", arguments->out, "Directory to write to; made if it is missing")->required();
  command->add_option("--integrator", arguments->integrator, "continuous, discrete or implicit; default the scene's");
  command->add_option("--step", arguments->step, "Time step [s]; default the scene's");
  command->add_option("--duration", arguments->duration, "Time to simulate [s]; default the scene's");
  command->add_option("--frames", arguments->frames, "Poses written per second; default 30");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
