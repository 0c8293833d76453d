// What the log says about contacts: certain ones, when they begin and end, and not too much of it.

#include "ros/monitor/contact_log.h"

#include "monitor/tracker_case.h"

namespace sdf_ccd::contact_log_test {

using namespace test;

class ContactLogTest : public TrackerTest {
 protected:
  std::vector<std::string> lines() { return log_.update(*tracker_, now_wall_); }

  ContactLog log_;
  ros::WallTime now_wall_{1000.0};
};

TEST_F(ContactLogTest, SaysWhenAContactBeginsAndEnds) {
  world({{"hand", "table"}});
  cycle({kThrough});
  std::vector<std::string> said = lines();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0], "Contact begins: hand - table at 100.000, 10 mm deep so far");
  cycle({kThrough});
  EXPECT_TRUE(lines().empty());
  cycle({});
  said = lines();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].find("Contact ends: hand - table at 100.200 after 0.200 s, up to 10 mm deep"), 0u) << said[0];
  EXPECT_NE(said[0].find(", 6 N"), std::string::npos) << said[0];
}

TEST_F(ContactLogTest, SaysNothingOfWhatIsUncertainUntilItIsAContact) {
  world({{"hand", "table"}});
  cycle({{Verdict::kUncertain, {{0.0, kLength, 1e-5}}}});
  EXPECT_TRUE(lines().empty());
  cycle({kThrough});
  EXPECT_EQ(lines().size(), 1u);
}

TEST_F(ContactLogTest, ABriefContactBeginsAndEndsAtOnce) {
  world({{"hand", "table"}});
  cycle({{Verdict::kContact, {{0.03, 0.04}}}});
  EXPECT_EQ(lines().size(), 2u);
}

TEST_F(ContactLogTest, SaysThatAContactIsNoLongerChecked) {
  world({{"hand", "table"}});
  cycle({kThrough});
  lines();
  cycle({{Verdict::kNotChecked, {}}});
  const std::vector<std::string> said = lines();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].find("Contact is no longer checked: hand - table"), 0u) << said[0];
}

TEST_F(ContactLogTest, SaysAtMostFiveLinesASecondAndHowManyItLeftOut) {
  world({{"hand", "a"}, {"hand", "b"}, {"hand", "c"}, {"hand", "d"}, {"hand", "e"}, {"hand", "f"}, {"hand", "g"}});
  cycle(std::vector<PairInput>(7, kThrough));
  EXPECT_EQ(lines().size(), 5u);
  cycle(std::vector<PairInput>(6, kThrough));
  EXPECT_TRUE(lines().empty());
  now_wall_ += ros::WallDuration(1.0);
  cycle({});
  const std::vector<std::string> said = lines();
  ASSERT_EQ(said.size(), 5u);
  EXPECT_NE(said[0].find("(and 3 lines about contacts before it)"), std::string::npos) << said[0];
}

}  // namespace sdf_ccd::contact_log_test
