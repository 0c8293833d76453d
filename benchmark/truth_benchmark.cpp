/// Checks verdicts on families of adversarial motions whose truth is known. Prints rows of results.csv, and failures to
/// stderr.

#include <algorithm>
#include <cstdio>

#include "adversarial/family.h"
#include "adversarial/public_queries.h"
#ifdef SDF_CCD_WITH_ROS
#include "adversarial/ros/ros_family.h"
#endif
#ifdef SDF_CCD_WITH_CGAL
#include "peers/cgal_triangles.h"
#endif
#include "results.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using test::Family;
using test::Tally;

constexpr long kPerSeed = 50'000;
constexpr long kPerStream = 100;  ///< one cycle of the family `ros` is run for so many motions of the others

struct Share {
  Family family;
  long cases;
};

std::vector<Share> shares(long motions) {
  std::vector<Share> all;
  for (const Family& family : test::families()) all.push_back({family, motions});
#ifdef SDF_CCD_WITH_ROS
  all.push_back({{"ros", test::rosStreams, 0}, std::max(1L, motions / kPerStream)});
#endif
  return all;
}

void printRows(const std::string& name, const Tally& tally) {
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"truth", name, "sdf_ccd", metric, value, unit, int(tally.cases)});
  };
  row("cases", double(tally.cases), "motions");
  row("clear", double(tally.clear), "motions");
  row("contact", double(tally.contact), "motions");
  row("false_clear", double(tally.false_clear), "motions");
  row("false_contact", double(tally.false_contact), "motions");
  row("false_bound", double(tally.false_bound), "motions");
  row("opposite", double(tally.opposite), "motions");
  row("uncertain_share", tally.uncertainShare(), "1");
  row("near_share", tally.nearShare(), "1");
  row("bound_over_error", tally.medianBoundOverError(), "1");
  for (const auto& [what, failure] : tally.failures)
    std::fprintf(stderr, "truth: %s: %ld × %s, the first %s\n", name.c_str(), failure.count, what.c_str(),
                 failure.first.c_str());
}

#ifdef SDF_CCD_WITH_CGAL
/// Compares the oracle's triangle distances with CGAL's.
void printOracle(long pairs) {
  const OracleError error = compareWithCgal(1, pairs);
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"truth", "oracle", "cgal", metric, value, unit, int(error.pairs)});
  };
  row("pairs", double(error.pairs), "triangles");
  row("touching", double(error.touching), "triangles");
  row("wrong_touch", double(error.wrong_touch), "triangles");
  row("largest_difference", error.largest, "1");
}
#endif

/// Queries of others, through triangles at six resolutions, and as thin bodies through the monitor.
void printPublic(const std::string& folder) {
  const std::vector<test::PublicQuery> queries = test::readPublicQueries(folder);
  printRows("public_triangles", test::publicTriangles(queries));
  printRows("public_bodies", test::publicBodies(queries));
}

void study(const StudyOptions& options) {
#ifdef SDF_CCD_WITH_CGAL
  if (isWanted(options.cases, "oracle")) printOracle(options.motions);
#endif
  if (!options.queries.empty() && isWanted(options.cases, "public")) printPublic(options.queries);
  for (const auto& [family, cases] : shares(options.motions)) {
    if (!isWanted(options.cases, family.name)) continue;
    Tally tally;
    for (std::uint64_t seed = 1; tally.cases < cases; ++seed)
      tally += family.run(seed, std::min(kPerSeed, cases - tally.cases));
    printRows(family.name, tally);
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full, quick;
  quick.motions = 5'000;
  return runStudy(argc, argv, "Whether any adversary makes a verdict untrue", full, quick, study);
}
