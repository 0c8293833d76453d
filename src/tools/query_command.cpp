#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <fmt/format.h>

#include "commands.h"
#include "common/number_text.h"
#include "field/field_access.h"
#include "mesh_field.h"
#include "output_file.h"
#include "print.h"
#include "progress_bar.h"
#include "query/least_distance.h"
#include "resolution_options.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/segments.h"
#include "segment_csv.h"
#include "time_option.h"

namespace sdf_ccd::tools {
namespace {

constexpr std::size_t kBlock = 4096;

struct QueryArguments {
  std::string field;
  std::string mesh;
  std::string segments;
  std::string out;
  ResolutionOptions resolution;
  TimeOption time;
  SegmentOptions query;
  bool impact = false;
};

DistanceField fieldOf(const QueryArguments& arguments) {
  if (!arguments.field.empty()) {
    DistanceField field = loadField(arguments.field);
    warnOfLost(arguments.field, {field, loadLostSurface(arguments.field)});
    return field;
  }
  FieldOptions options = arguments.resolution.fieldOptions();
  options.band = std::max(options.band, std::abs(arguments.query.sigma));
  const OrientedMesh oriented = orientWithWarning(arguments.mesh, loadMesh(arguments.mesh));
  MadeSolid made;
  return buildFileField(arguments.mesh, oriented.mesh, made, options, arguments.resolution.thinWalls());
}

/// Calls `answer` with the index of each segment, on all cores.
void forEachSegment(std::size_t count, const std::function<void(std::size_t)>& answer) {
  ProgressBar bar("segments");
  std::mutex bar_mutex;
  std::size_t done = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kBlock), [&](const auto& block) {
    for (std::size_t i = block.begin(); i < block.end(); ++i) answer(i);
    const std::lock_guard<std::mutex> lock(bar_mutex);
    done += block.size();
    bar(static_cast<double>(done) / static_cast<double>(count));
  });
}

void writeIntervals(const DistanceField& field, const std::vector<Segment>& segments, const SegmentOptions& options,
                    std::ostream& out) {
  std::vector<Intervals> intervals(segments.size());
  forEachSegment(segments.size(), [&](std::size_t i) { segmentIntervals(field, segments[i], options, intervals[i]); });
  out << "segment,t_enter,t_exit\n";
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    for (const Interval& interval : intervals[i]) {
      out << fmt::format("{},{:.17g},{:.17g}\n", i, interval.enter, interval.exit);
    }
  }
}

/// Time of impact of a moving point with the true surface, and the depth it reaches.
struct Impact {
  ImpactWindow window;
  LeastDistance depth;
};

void writeImpacts(const DistanceField& field, const std::vector<Segment>& segments, std::ostream& out) {
  std::vector<std::optional<Impact>> impacts(segments.size());
  forEachSegment(segments.size(), [&](std::size_t i) {
    if (const auto window = impactWindow(field, segments[i])) impacts[i] = {*window, leastDistance(field, segments[i])};
  });
  const auto cell = [](const std::optional<double>& number) {
    return number ? fmt::format("{:.17g}", *number) : std::string();
  };
  out << "segment,t_earliest,t,t_latest,depth,depth_low,depth_high\n";
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    if (!impacts[i]) continue;
    // A point may be inside only because a cap closes an opening: no latest time and no minimum depth are known then.
    const bool is_certain = !FieldAccess::openings(field);
    const auto& [window, depth] = *impacts[i];
    out << i << ',' << cell(window.earliest) << ',' << cell(window.time) << ','
        << cell(is_certain ? window.latest : std::nullopt) << ','
        << cell(std::clamp(-depth.value, -depth.high, -depth.low)) << ','
        << cell(is_certain ? std::optional(-depth.high) : std::nullopt) << ',' << cell(-depth.low) << '\n';
  }
}

void run(const QueryArguments& arguments) {
  if (!std::isfinite(arguments.query.sigma)) throw std::invalid_argument("--sigma is not finite");
  if (arguments.impact && (arguments.query.sigma != 0.0 || arguments.query.mode != SegmentMode::kAll)) {
    throw std::invalid_argument(
        "--impact always uses the surface and the first contact; it cannot be combined with --sigma or --first");
  }
  const std::vector<Segment> segments = readSegments(arguments.segments);
  std::error_code is_missing;
  if (std::filesystem::equivalent(arguments.out, arguments.segments, is_missing))
    throw std::invalid_argument("--out and --segments are the same file");
  if (!arguments.field.empty()) arguments.resolution.requireNone("--field names a field that exists already");
  OutputFile out(arguments.out);
  const DistanceField field = arguments.time.limit([&] { return fieldOf(arguments); });
  if (std::abs(arguments.query.sigma) > field.band()) {
    throw std::invalid_argument("--sigma " + shortText(arguments.query.sigma) + " lies outside the field's band of " +
                                shortText(field.band()) + " m");
  }
  if (FieldAccess::openings(field)) std::cerr << "warning: openings: " << describeOpenings(field) << std::endl;
  if (arguments.impact) {
    writeImpacts(field, segments, out.stream());
  } else {
    writeIntervals(field, segments, arguments.query, out.stream());
  }
  out.commit();
}

}  // namespace

void addQueryCommand(CLI::App& app) {
  auto arguments = std::make_shared<QueryArguments>();
  CLI::App* command = app.add_subcommand("query", "Times during which moving points are inside an isosurface");
  command->footer(
      "In: a line ox,oy,oz,ex,ey,ez [m] per segment; an optional first line holds these names. Out: a line "
      "segment,t_enter,t_exit per interval; segments count from 0, times run from 0 at the start to 1 at the end of "
      "the segment.");
  auto* source = command->add_option_group("source");
  source->add_option("--field", arguments->field, "Field file, made by build");
  source->add_option("--mesh", arguments->mesh, "Mesh file, of which a field is made");
  source->require_option(1);
  command->add_option("--segments", arguments->segments, "CSV file to read")->required();
  command->add_option("--out", arguments->out, "CSV file to write")->required();
  command->add_option("--sigma", arguments->query.sigma, "Distance of the isosurface from the surface [m]; default 0");
  command->add_flag_callback(
      "--first", [arguments] { arguments->query.mode = SegmentMode::kFirstInterval; },
      "Only the first interval of each segment");
  command->add_flag(
      "--impact", arguments->impact,
      "Instead of intervals: time of impact and maximum depth of each segment that may touch the surface: "
      "segment,t_earliest,t,t_latest,depth,depth_low,depth_high. The truth lies between the bounds; "
      "empty: not known, as the point may only graze, or an opening's cap be all that it meets");
  arguments->resolution.addTo(*command);
  arguments->time.addTo(*command);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
