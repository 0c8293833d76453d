#include "report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace sdf_ccd::precision {
namespace {

std::string number(double value, const char* format = "{:.6g}") {
  return std::isnan(value) ? "" : fmt::format(format, value);
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
  return right ? blanks + text : text + blanks;
}

using Cells = std::vector<std::string>;

std::string aligned(const std::vector<Cells>& rows, std::size_t left_columns) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += "  " + padded(row[i], widths[i], i >= left_columns);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string csvText(const StudyResult& result) {
  std::string text =
      "study,quantity,error_unit,system,setting,value,seconds_per_query,error_median,error_p99,error_max,bound,missed,"
      "queries\n";
  for (const Measurement& row : result.rows) {
    text += result.study + "," + row.quantity + "," + row.unit + "," + row.system + "," + row.setting + "," +
            number(row.value) + "," + number(row.seconds) + "," + number(row.error.median) + "," +
            number(row.error.p99) + "," + number(row.error.max) + "," + number(row.bound) + "," +
            std::to_string(row.missed) + "," + std::to_string(row.error.count + row.missed) + "\n";
  }
  return text;
}

std::string tableText(const StudyResult& result) {
  std::string text = result.title + "; time per " + result.query + "\n";
  std::vector<std::string> quantities;
  for (const Measurement& row : result.rows) {
    if (std::find(quantities.begin(), quantities.end(), row.quantity) == quantities.end())
      quantities.push_back(row.quantity);
  }
  for (const std::string& quantity : quantities) {
    std::vector<Cells> rows{{"system", "setting", "us/query", "median", "p99", "maximum", "bound", "missed"}};
    std::string unit;
    for (const Measurement& row : result.rows) {
      if (row.quantity != quantity) continue;
      unit = row.unit;
      rows.push_back({row.system, row.setting, number(1e6 * row.seconds, "{:.3g}"), number(row.error.median, "{:.2e}"),
                      number(row.error.p99, "{:.2e}"), number(row.error.max, "{:.2e}"), number(row.bound, "{:.2e}"),
                      std::to_string(row.missed) + "/" + std::to_string(row.error.count + row.missed)});
    }
    text += "\n" + quantity + " [" + unit + "]\n" + aligned(rows, 2);
  }
  return text;
}

}  // namespace sdf_ccd::precision
