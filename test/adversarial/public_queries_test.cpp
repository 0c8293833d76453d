// Verdicts on public queries of continuous collision detection, whose truth is known exactly.

#include "adversarial/public_queries.h"

#include <gtest/gtest.h>

#include "oracle/test_data.h"

namespace sdf_ccd::test::public_queries_test {

void expectNoneWrong(const Tally& tally) {
  for (const auto& [what, failure] : tally.failures)
    ADD_FAILURE() << failure.count << " of " << tally.cases << ": " << what << ", the first " << failure.first;
  EXPECT_TRUE(tally.holds());
  EXPECT_GT(tally.clear, tally.cases / 50);
}

TEST(PublicQueries, NoneIsAnsweredWronglyThroughTriangles) {
  SDF_CCD_NEEDS_DATA("ccd_queries");
  const std::vector<PublicQuery> queries = readPublicQueries(dataPath("ccd_queries"));
  EXPECT_EQ(queries.size(), 1377u) << "all of the 7,279 that are rigid";
  expectNoneWrong(publicTriangles(queries));
}

TEST(PublicQueries, NoneIsAnsweredWronglyAsThinBodies) {
  SDF_CCD_NEEDS_DATA("ccd_queries");
  std::vector<PublicQuery> some;
  const std::vector<PublicQuery> all = readPublicQueries(dataPath("ccd_queries"));
  for (std::size_t i = 0; i < all.size(); i += 20) some.push_back(all[i]);  // all are in the study `truth`
  const Tally tally = publicBodies(some);
  expectNoneWrong(tally);
  EXPECT_GT(tally.contact, tally.cases / 50);
}

}  // namespace sdf_ccd::test::public_queries_test
