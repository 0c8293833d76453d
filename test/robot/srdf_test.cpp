#include "sdf_ccd/robot.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"

namespace sdf_ccd::srdf_test {

std::string failure(const std::string& xml) {
  return test::failureOf([&] { parseSrdf(xml); });
}

TEST(Srdf, ReadsPairsWithTheirReasons) {
  const Srdf srdf = parseSrdf(R"(<?xml version="1.0"?>
    <!-- a comment -- with dashes -->
    <robot name="arm">
      <group name="all"><link name="a"/></group>
      <disable_collisions link1="a" link2="b" reason="Adjacent"/>
      <disable_collisions link1="a" link2="c"/>
      <disable_default_collisions link="d"/>
      <enable_collisions link1="d" link2="a"/>
    </robot>)");
  ASSERT_EQ(srdf.disabled.size(), 2u);
  EXPECT_EQ(srdf.disabled[0].body_a, "a");
  EXPECT_EQ(srdf.disabled[0].body_b, "b");
  EXPECT_EQ(srdf.disabled[0].text, "SRDF: Adjacent");
  EXPECT_EQ(srdf.disabled[1].text, "SRDF: no reason given");
  EXPECT_EQ(srdf.disabled_by_default, std::vector<std::string>{"d"});
  ASSERT_EQ(srdf.enabled.size(), 1u);
  EXPECT_EQ(srdf.enabled[0], (std::pair<std::string, std::string>("d", "a")));
}

TEST(Srdf, MalformedTextGivesLineAndReason) {
  EXPECT_NE(failure("<robot>\n<group>\n</robot>").find("line 2: XML_ERROR_MISMATCHED_ELEMENT"), std::string::npos)
      << failure("<robot>\n<group>\n</robot>");
  EXPECT_NE(failure("").find("line"), std::string::npos);
  EXPECT_NE(failure("<!-- nothing -->").find("its root is missing"), std::string::npos);
  EXPECT_NE(failure("<model/>").find("its root is <model>, not <robot>"), std::string::npos);
}

TEST(Srdf, AnElementThatLacksANameCostsNoOther) {
  const Srdf srdf = parseSrdf(R"(<robot name="r">
<disable_collisions link1="a" reason="Never"/>
<disable_collisions link1="a" link2="a"/>
<disable_default_collisions/>
<virtual_joint name="odom"/>
<enable_collisions link1="c" link2=""/>
<disable_collisions link1="a" link2="b"/></robot>)");
  ASSERT_EQ(srdf.disabled.size(), 1u);
  EXPECT_EQ(srdf.disabled[0].body_b, "b");
  EXPECT_TRUE(srdf.disabled_by_default.empty());
  EXPECT_TRUE(srdf.virtual_joints.empty());
  EXPECT_EQ(srdf.enabled, (std::vector<std::pair<std::string, std::string>>{{"c", "*"}}))
      << "what is to be checked must not be left out";
  EXPECT_EQ(srdf.warnings, (std::vector<std::string>{
                               "line 2 of the SRDF: disable_collisions lacks the attribute link2, and is ignored",
                               "line 3 of the SRDF: disable_collisions names the link a twice, and is ignored",
                               "line 4 of the SRDF: disable_default_collisions lacks the attribute link, and is "
                               "ignored",
                               "line 5 of the SRDF: virtual_joint lacks the attribute child_link, and is ignored",
                               "line 6 of the SRDF: enable_collisions lacks the attribute link2, and counts for "
                               "all links"}));
}

TEST(Srdf, DeepAndLargeTextsAreRefused) {
  std::string deep = "<robot>";
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_NE(failure(deep), "");
  EXPECT_NE(failure(std::string(std::size_t{65} << 20, ' ')).find("larger than 64 MiB"), std::string::npos);
}

TEST(Srdf, MacrosThatWereNotExpandedAreNamed) {
  EXPECT_TRUE(parseSrdf("<robot name='r'><group name='all'/></robot>").warnings.empty());
  EXPECT_EQ(
      parseSrdf("<robot name='r' xmlns:xacro='x'>\n<xacro:arm/><disable_collisions link1='${p}a' link2='b'/>"
                "</robot>")
          .warnings,
      std::vector<std::string>{"line 2 of the SRDF: xacro has not expanded it, and what it stands for is missing"});
}

}  // namespace sdf_ccd::srdf_test
