#include <algorithm>
#include <clocale>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "commands.h"
#include "plain_output.h"

namespace {

constexpr int kPartlyDone = 1;
constexpr int kBadInput = 2;

/// Prints a message as one line on stderr, without its line breaks. @return the exit code of bad input.
int refuse(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "sdf_ccd: " << message << std::endl;
  return kBadInput;
}

/// Refuses an option that is given without a value, as by a script whose variable is empty.
void refuseEmptyValues(CLI::App& app) {
  const auto isGiven = [](const std::string& value) {
    return value.empty() ? std::string("it is empty: give a value, or leave the option out") : std::string();
  };
  for (const CLI::Option* option : static_cast<const CLI::App&>(app).get_options())
    app.get_option(option->get_name())->check(isGiven, "");
  for (CLI::App* part : app.get_subcommands([](const CLI::App*) { return true; })) refuseEmptyValues(*part);
}

/// @return the exit code: another one if standard output did not take everything, as on a full disk.
int finished(int code) {
  if (std::cout.flush()) return code;
  refuse("standard output did not take everything");
  return code == 0 ? kPartlyDone : code;
}

int runTool(int argc, char** argv) {
  CLI::App app("Signed distance fields of robots and worlds, and queries against them. Lengths are metres.", "sdf_ccd");
  app.require_subcommand(1);
  app.set_version_flag("--version", "sdf_ccd " SDF_CCD_VERSION);
  std::string footer = "Exit code: 0 done, 1 partly done (the rest is named on stderr), 2 bad input.";
  sdf_ccd::tools::addBuildCommand(app);
  sdf_ccd::tools::addInfoCommand(app);
  sdf_ccd::tools::addQueryCommand(app);
  sdf_ccd::tools::addLearnPairsCommand(app);
  sdf_ccd::tools::addSimulateCommand(app);
  sdf_ccd::tools::addWorkPrecisionCommand(app);
#ifdef SDF_CCD_WITH_ROS
  sdf_ccd::tools::addCheckBagCommand(app);
  sdf_ccd::tools::addPlotBagCommand(app);
#else
  footer += " Built without ROS: check-bag and plot-bag are left out.";
#endif
  app.footer(footer);
  refuseEmptyValues(app);
  try {
    const std::string first = argc > 1 ? argv[1] : "-";
    const auto is_first = [&](const CLI::App* command) { return command->get_name() == first; };
    if (first.rfind("-", 0) != 0 && app.get_subcommands(is_first).empty())
      return refuse("there is no subcommand " + first + " (see --help)");
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : refuse(error.what() + std::string(" (see --help)"));
  } catch (const sdf_ccd::tools::PartlyDone&) {
    return kPartlyDone;
  } catch (const std::bad_alloc&) {
    return refuse("not enough memory");
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setlocale(LC_NUMERIC, "C");  // also where a library has chosen another: numbers in options, tables and plots
  const sdf_ccd::tools::PlainOutput out(std::cout), error(std::cerr);
  return finished(runTool(argc, argv));
}
