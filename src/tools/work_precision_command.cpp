#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "commands.h"
#include "mesh/generated_mesh.h"
#include "output_file.h"
#include "precision/gnuplot.h"
#include "precision/report.h"
#include "precision/studies.h"
#include "progress_bar.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::tools {
namespace {

using precision::Study;
using precision::StudyResult;

constexpr int kQueries = 2000, kQuickQueries = 400;

struct WorkPrecisionArguments {
  std::string study;
  std::string out;
  std::string mesh;
  std::optional<int> queries;
  bool quick = false;
};

std::string studyNames() {
  std::string names;
  for (const Study& study : precision::studies()) names += (names.empty() ? "" : ", ") + std::string(study.name);
  return names;
}

std::vector<Study> chosen(const std::string& name) {
  const std::vector<Study>& all = precision::studies();
  if (name.empty()) return all;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Study& study) { return name == study.name; });
  if (found == all.end()) throw std::invalid_argument("unknown study `" + name + "`; known: " + studyNames());
  return {*found};
}

TriangleMesh meshOf(const std::string& file) {
  if (file.empty()) return blobMesh(0.1, 0.35, 4000);
  OrientedMesh oriented = orientOutward(loadMesh(file));
  if (!oriented.quality.sign_trusted) {
    throw std::invalid_argument(
        file + ": inside and outside must be certain to measure errors, but: " + summary(oriented.quality));
  }
  return std::move(oriented.mesh);
}

void writePlot(const StudyResult& result, const std::string& path) {
  OutputPath plot(path);
  precision::runGnuplot(precision::plotScript(result, plot.part()));
  plot.commit();
}

void run(const WorkPrecisionArguments& arguments) {
  const std::vector<Study> wanted = chosen(arguments.study);
  precision::StudyInput input;
  input.mesh = meshOf(arguments.mesh);
  input.queries = arguments.queries.value_or(arguments.quick ? kQuickQueries : kQueries);
  if (input.queries < 10 || input.queries > 10'000'000) throw std::invalid_argument("--queries must be 10 to 1e7");
  input.quick = arguments.quick;
  const bool can_plot = precision::haveGnuplot();
  const OutputDirectory directory(arguments.out);
  for (const Study& study : wanted) {
    OutputFile csv(directory.file(std::string(study.name) + ".csv"));
    StudyResult result;
    {
      ProgressBar bar(study.name);
      input.progress = [&bar](double share) { bar(share); };
      result = study.run(input);
    }
    csv.stream() << precision::csvText(result);
    csv.commit();
    std::cout << precision::tableText(result) << std::endl;
    if (can_plot) writePlot(result, directory.file(std::string(study.name) + ".svg"));
  }
  if (!can_plot) {
    std::cerr << "sdf_ccd: gnuplot not found, so there is no plot (Debian: gnuplot-nox); the tables are in "
              << arguments.out << "/*.csv" << std::endl;
    throw PartlyDone();
  }
}

}  // namespace

void addWorkPrecisionCommand(CLI::App& app) {
  auto arguments = std::make_shared<WorkPrecisionArguments>();
  CLI::App* command = app.add_subcommand("work-precision", "Studies of error against run time");
  std::string described = "Studies:\n";
  for (const Study& study : precision::studies()) {
    described += fmt::format("  {:<12}{}\n", study.name, study.description);
  }
  command->footer(
      described +
      "Each runs the same random queries at every setting, in turn, on one thread, prints a table and writes "
      "DIR/STUDY.csv and, with gnuplot, DIR/STUDY.svg. Uniform fields have 16 bits a sample; adaptive ones "
      "(of a maximum error) 7 bits per corner of a leaf, whose rounding is part of that error. Exit code 1: no plot, "
      "as gnuplot is not installed.");
  command->add_option("study", arguments->study, "One of the studies below; all if omitted");
  command->add_option("--out", arguments->out, "Directory to write to; made if it is missing")->required();
  command->add_option("--mesh", arguments->mesh,
                      "Closed mesh that fields and shells are made of; default a lumpy ball of 0.2 m (not for step)");
  command->add_option("--queries", arguments->queries,
                      "Segments or points per setting; default 2000. Fewer for motions of bodies");
  command->add_flag("--quick", arguments->quick, "A fifth of the queries, without the finest settings");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
