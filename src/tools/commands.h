#pragma once

#include <CLI/CLI.hpp>

namespace sdf_ccd::tools {

/// Each adds one subcommand; its callback does the work and throws if it cannot.
void addBuildCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addLearnPairsCommand(CLI::App& app);
void addQueryCommand(CLI::App& app);
void addSimulateCommand(CLI::App& app);
void addWorkPrecisionCommand(CLI::App& app);

/// Subcommands that need ROS, in the folder ros/.
void addCheckBagCommand(CLI::App& app);
void addPlotBagCommand(CLI::App& app);

/// Thrown when part of the work failed and has been reported on stderr: exit code 1.
struct PartlyDone {};

}  // namespace sdf_ccd::tools
