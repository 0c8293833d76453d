#include <gtest/gtest.h>

#include "precision/report.h"

namespace sdf_ccd::precision::plot_test {

Measurement point(const std::string& system, const std::string& setting, double seconds, double error) {
  Measurement row;
  row.quantity = "depth";
  row.unit = "m";
  row.system = system;
  row.setting = setting;
  row.seconds = seconds;
  row.error = {error, 2.0 * error, 3.0 * error, 100};
  return row;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The points of two similar systems coincide; only one of their names may be drawn there.
TEST(Plot, NamesOfSettingsDoNotCoverEachOther) {
  const std::vector<Measurement> rows{point("a", "4 mm", 1e-6, 1e-3), point("a", "1 mm", 1e-5, 1e-5),
                                      point("b", "4 mm", 1.02e-6, 1e-3), point("b", "1 mm", 1e-4, 1e-5)};
  const std::string script = plotScript({"cell", "title", "cell [m]", "place", rows}, "out.svg");
  EXPECT_EQ(count(script, "\"4 mm\""), 1);
  EXPECT_EQ(count(script, "\"1 mm\""), 2);
  EXPECT_EQ(count(script, "\"\"\n"), 1);
  EXPECT_NE(script.find("1.02 0.001 0.002 0.003 \"\""), std::string::npos) << script;
}

}  // namespace sdf_ccd::precision::plot_test
