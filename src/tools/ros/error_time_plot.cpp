#include "error_time_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "precision/gnuplot.h"

namespace sdf_ccd::tools {
namespace {

constexpr double kAcross = 500.0, kUp = 300.0;  // dots that a panel can show side by side

struct Point {
  double x, y;
};

/// One panel's points, per verdict.
using Points = std::array<std::vector<Point>, 4>;

constexpr std::array<Verdict, 4> kVerdicts = {Verdict::kClear, Verdict::kUncertain, Verdict::kContact,
                                              Verdict::kNotChecked};
constexpr std::array<const char*, 4> kColors = {"#55a868", "#dd8452", "#c44e52", "#8c8c8c"};
constexpr std::array<int, 4> kShapes = {7, 5, 9, 6};

constexpr const char* kLeft = R"(
set multiplot
set grid lc rgb '#dddddd'
set lmargin at screen 0.06
set rmargin at screen 0.485
set bmargin at screen 0.12
set tmargin at screen 0.88
set key bottom right samplen 1
set logscale x
set format x '%g'
set xlabel 'run time of a cycle [ms]'
set yrange [0:*]
set ylabel 'largest error bound of a cycle [mm]'
)";

constexpr const char* kUpperRight = R"(
unset label
unset key
unset logscale
set lmargin at screen 0.565
set rmargin at screen 0.985
set bmargin at screen 0.53
set format x ''
unset xlabel
set ylabel 'error bound [mm]'
)";

constexpr const char* kLowerRight = R"(
set bmargin at screen 0.12
set tmargin at screen 0.49
set format x '%g'
set xlabel 'time since the first cycle [s]'
set logscale y
set yrange [*:*]
set format y '%g'
set ylabel 'run time [ms]'
)";

/// Keeps one of the points that would be drawn at the same dot: otherwise an hour of cycles makes a file that no viewer
/// opens.
std::vector<Point> thinned(const std::vector<Point>& points) {
  if (points.empty()) return {};
  Point low = points.front(), high = points.front();
  for (const Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const auto dot = [](double value, double from, double to, double count) {
    return to > from ? std::lround(count * (value - from) / (to - from)) : 0L;
  };
  std::set<std::pair<long, long>> drawn;
  std::vector<Point> kept;
  for (const Point& p : points) {
    if (drawn.insert({dot(p.x, low.x, high.x, kAcross), dot(p.y, low.y, high.y, kUp)}).second) kept.push_back(p);
  }
  return kept;
}

/// Writes the gnuplot data blocks `$name0`, `$name1`, …, one per verdict.
void writeData(const std::string& name, const Points& points, std::ostringstream& script) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    script << "$" << name << v << " << EOD\n";
    for (const Point& p : thinned(points[v])) script << p.x << " " << p.y << "\n";
    script << "EOD\n";
  }
}

/// @param columns  for gnuplot's `using`.
void writePlot(const std::string& name, const Points& points, const std::string& columns, std::ostringstream& script) {
  std::string separator = "plot ";
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (points[v].empty()) continue;
    script << separator << "$" << name << v << " using " << columns << " with points pt " << kShapes[v]
           << " ps 0.45 lc rgb '" << kColors[v] << "' title '" << toString(kVerdicts[v]) << "' noenhanced";
    separator = ", ";
  }
  script << "\n";
}

std::string scriptOf(const std::vector<CycleRecord>& cycles, const ros::Time& origin, const PlotTitle& title,
                     const std::string& svg) {
  // Points are thinned on the scale on which they are drawn, so run times are logarithms here.
  Points error_time, error, run_time;
  double first = (cycles.front().start - origin).toSec(), last = first;
  for (const CycleRecord& cycle : cycles) {
    const auto v = std::size_t(std::find(kVerdicts.begin(), kVerdicts.end(), cycle.verdict) - kVerdicts.begin());
    const double time = (cycle.end - origin).toSec();  // before the first after time has jumped back
    const double took = std::log10(std::max(1e3 * cycle.run_time, 1e-6));
    first = std::min(first, time);
    last = std::max(last, time);
    run_time[v].push_back({time, took});
    if (!cycle.hasBound()) continue;
    error[v].push_back({time, 1e3 * cycle.error_bound});
    error_time[v].push_back({took, 1e3 * cycle.error_bound});
  }
  std::ostringstream script;
  script.imbue(std::locale::classic());
  script << "set terminal svg size 1100,560 font 'sans,13' background 'white'\nset output " << precision::quoted(svg)
         << "\n";
  writeData("error_time", error_time, script);
  writeData("error", error, script);
  writeData("run_time", run_time, script);
  script << "set label 1 " << precision::quoted(title.title)
         << " at screen 0.5,0.965 center noenhanced font ',15'\nset label 2 " << precision::quoted(title.subtitle)
         << " at screen 0.5,0.92 center noenhanced font ',12'\n"
         << kLeft;
  writePlot("error_time", error_time, "(10**$1):2", script);
  script << kUpperRight << "set xrange [" << first << ":" << last << "]\n";
  writePlot("error", error, "1:2", script);
  script << kLowerRight;
  writePlot("run_time", run_time, "1:(10**$2)", script);
  script << "unset multiplot\nunset output\n";
  return script.str();
}

}  // namespace

bool plotErrorTime(const std::vector<CycleRecord>& cycles, const ros::Time& origin, const PlotTitle& title,
                   const std::string& svg) {
  const bool has_bound = std::any_of(cycles.begin(), cycles.end(), [](const CycleRecord& r) { return r.hasBound(); });
  if (!has_bound || !precision::haveGnuplot()) return false;
  try {
    precision::runGnuplot(scriptOf(cycles, origin, title, svg));
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace sdf_ccd::tools
