#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "gnuplot.h"
#include "report.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kPanelWidth = 520, kPanelHeight = 440, kTitleHeight = 50, kKeyHeight = 18;  // [pixels]
constexpr double kSmallest = 1e-12;  // smaller errors, also zero, are drawn at this value
const char* const kColors[] = {"#4c72b0", "#dd8452", "#55a868", "#c44e52", "#8172b3", "#937860",
                               "#da8bc3", "#8c8c8c", "#ccb974", "#64b5cd", "#1b4f72", "#7d6608"};

std::vector<std::string> distinct(const StudyResult& result, std::string Measurement::*member) {
  std::vector<std::string> found;
  for (const Measurement& row : result.rows) {
    if (std::find(found.begin(), found.end(), row.*member) == found.end()) found.push_back(row.*member);
  }
  return found;
}

/// The points of a system in one panel.
std::vector<Measurement> pointsOf(const StudyResult& result, const std::string& quantity, const std::string& system) {
  std::vector<Measurement> points;
  for (const Measurement& row : result.rows) {
    if (row.quantity == quantity && row.system == system) points.push_back(row);
  }
  return points;
}

/// Number of systems with several settings in a panel; they are drawn as lines.
int linesIn(const StudyResult& result, const std::string& quantity) {
  int lines = 0;
  for (const std::string& system : distinct(result, &Measurement::system)) {
    lines += pointsOf(result, quantity, system).size() > 1;
  }
  return lines;
}

/// The range of a panel along an axis, with a margin; for times the upper one is wider, for the names of settings.
struct Range {
  double low = 1e300, high = 0.0;

  Range(const StudyResult& result, const std::string& quantity, bool of_time) {
    for (const Measurement& row : result.rows) {
      if (row.quantity != quantity) continue;
      low = std::min(low, of_time ? 1e6 * row.seconds : row.error.median);
      high = std::max(high, of_time ? 1e6 * row.seconds : row.error.max);
    }
    low = std::max(low, kSmallest);
    high = std::max(high, low);
    const double margin = 0.05 * std::log10(high / low) + 0.1;  // powers of ten
    low /= std::pow(10.0, margin);
    high *= std::pow(10.0, of_time ? 3.0 * margin : margin);
  }

  /// Position of a value on the logarithmic axis: 0 at `low`, 1 at `high`.
  double share(double value) const { return std::log(value / low) / std::log(high / low); }

  std::string text() const { return fmt::format("[{:.3g}:{:.3g}]", low, high); }

  /// Tics at powers of ten, and between them if the range is short.
  std::string tics() const {
    std::string text;
    const int last = static_cast<int>(std::ceil(std::log10(high)));
    for (int exponent = static_cast<int>(std::floor(std::log10(low))); exponent < last; ++exponent) {
      const double decade = std::pow(10.0, exponent);
      for (const double digit : {1.0, 1.2, 1.5, 2.0, 3.0, 5.0, 7.0}) {
        const bool wanted = digit == 1.0 || high < (digit == 2.0 || digit == 5.0 ? 300.0 : 4.0) * low;
        if (!wanted) continue;
        text += fmt::format("{}{:g}", text.empty() ? "" : ",", digit * decade);
      }
    }
    return "(" + text + ")";
  }
};

/// The names of settings placed so far in a panel.
class PlacedNames {
 public:
  PlacedNames(const Range& times, const Range& errors) : times_(times), errors_(errors) {}

  /// Adds the name at this point if it would cover no other name. @return whether it was added.
  bool add(const Measurement& point) {
    const Position at{times_.share(1e6 * point.seconds), errors_.share(std::max(point.error.median, kSmallest))};
    for (const Position& other : placed_) {
      if (std::abs(at.x - other.x) < 0.15 && std::abs(at.y - other.y) < 0.04) return false;
    }
    placed_.push_back(at);
    return true;
  }

 private:
  struct Position {
    double x, y;
  };

  Range times_, errors_;
  std::vector<Position> placed_;
};

/// Data lines: microseconds, median, 99th percentile, maximum, and the setting's name (empty if it is not shown).
/// @param ends_only  show only the names of the first and the last setting.
std::string dataLines(const std::vector<Measurement>& points, bool ends_only, PlacedNames& names) {
  std::string lines;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Measurement& row = points[i];
    const std::string numbers =
        fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} ", 1e6 * row.seconds, std::max(row.error.median, kSmallest),
                    std::max(row.error.p99, kSmallest), std::max(row.error.max, kSmallest));
    const bool wanted = points.size() > 1 && (!ends_only || i == 0 || i + 1 == points.size());
    lines += numbers + ("\"" + (wanted && names.add(row) ? row.setting : "") + "\"\n");
  }
  return lines;
}

}  // namespace

std::string plotScript(const StudyResult& result, const std::string& svg_path) {
  const std::vector<std::string> quantities = distinct(result, &Measurement::quantity);
  const std::vector<std::string> systems = distinct(result, &Measurement::system);
  std::string blocks, panels;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    std::string unit, plots;
    for (const Measurement& row : result.rows) {
      if (row.quantity == quantities[q]) unit = row.unit;
    }
    const bool crowded = linesIn(result, quantities[q]) > 2;
    const Range times(result, quantities[q], true), errors(result, quantities[q], false);
    PlacedNames names(times, errors);
    for (std::size_t s = 0; s < systems.size(); ++s) {
      const std::vector<Measurement> points = pointsOf(result, quantities[q], systems[s]);
      if (points.empty()) continue;
      const std::string block = "$d" + std::to_string(q) + "_" + std::to_string(s);
      const std::string color = std::string(" lc rgb '") + kColors[s % std::size(kColors)] + "'";
      blocks += block + " << EOD\n" + dataLines(points, crowded, names) + "EOD\n";
      if (!plots.empty()) plots += ", \\\n  ";
      plots += fmt::format(
          "{0} using 1:2:(0):($4-$2) with vectors nohead lw 1{1} notitle, \\\n"
          "  {0} using 1:4 with points pt 1 ps 0.4{1} notitle, \\\n"
          "  {0} using 1:3 with points pt 2 ps 0.6{1} notitle, \\\n"
          "  {0} using 1:2 with lines lw 2{1} notitle, \\\n"
          "  {0} using 1:2 with points pt 7 ps 0.7{1} title {2} noenhanced",
          block, color, quoted(systems[s]));
      if (points.size() > 1) {
        plots += ", \\\n  " + block + " using 1:2:5 with labels left offset 0.6,0.5 font ',9' textcolor rgb '" +
                 kColors[s % std::size(kColors)] + "' notitle noenhanced";
      }
    }
    panels += fmt::format(
        "set xrange {}\nset xtics {}\nset yrange {}\nset title {} noenhanced\nset ylabel {} noenhanced\nplot {}\n",
        times.text(), times.tics(), errors.text(), quoted(quantities[q]), quoted("error [" + unit + "]"), plots);
  }
  const int width = kPanelWidth * int(quantities.size());
  return "set terminal svg size " + std::to_string(width) + "," +
         std::to_string(kPanelHeight + kTitleHeight + kKeyHeight * int(systems.size())) +
         " font 'sans,12' background '#ffffff'\nset output " + quoted(svg_path) + "\n" + blocks +
         "set logscale xy\nset format y '10^{%L}'\nset grid\nset key below maxcols 1\nset bmargin " +
         std::to_string(5 + systems.size()) + "\n" + "set xlabel " +
         quoted("median time per " + result.query + " [us]") + " noenhanced\nset multiplot layout 1," +
         std::to_string(quantities.size()) + " title \"" + result.title +
         "\\n{/*0.8 dot: median; cross: 99th percentile; bar: up to the maximum}\"\n" + panels + "unset multiplot\n";
}

}  // namespace sdf_ccd::precision
