#include "ros/tf/prefix_hint.h"

#include <gtest/gtest.h>

#include "ros/tf/tf_history.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::prefix_hint_test {

using namespace test;

TEST(PrefixHint, NamesAPrefixThatAllFramesHave) {
  const std::vector<std::string> links = {"base_link", "arm/hand"};
  EXPECT_EQ(prefixHint(links, {"odom", "tb1/base_link"}), "tf has tb1/base_link: is tf_prefix tb1?");
  EXPECT_EQ(prefixHint(links, {"a/b/arm/hand"}), "tf has a/b/arm/hand: is tf_prefix a/b?");
  EXPECT_EQ(prefixHint(links, {"base_link", "tb1/base_link"}), "") << "another robot's";
  EXPECT_EQ(prefixHint(links, {"odom", "tb1/base_link_2", "tb1base_link"}), "");
  EXPECT_EQ(prefixHint({"tb1/base_link"}, {"tb2/tb1"}), "");
}

TEST(PrefixHint, TheHistoryTellsTheFramesThatTfHas) {
  TfHistoryOptions options;
  options.wanted = {"base_link"};
  TfHistory history("base_link", options);
  EXPECT_TRUE(history.frames().empty()) << "nothing has been received";
  history.add(message({stampedTransform("tb1/odom", "tb1/base_link", 1.0, 0.0)}), false);
  EXPECT_EQ(prefixHint({"base_link"}, history.frames()).rfind("tf has tb1/base_link", 0), 0u);
}

}  // namespace sdf_ccd::prefix_hint_test
