#include "scene/pair_rules.h"

#include <gtest/gtest.h>

#include <random>

namespace sdf_ccd::pair_rules_test {

TEST(NamePattern, StarsAndQuestionMarks) {
  EXPECT_TRUE(matches("hand", "hand"));
  EXPECT_FALSE(matches("hand", "hands"));
  EXPECT_FALSE(matches("hands", "hand"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("*_finger_?", "l_finger_1"));
  EXPECT_FALSE(matches("*_finger_?", "l_finger_10"));
  EXPECT_TRUE(matches("a*b*c", "aXbYbZc"));
  EXPECT_FALSE(matches("a*b*c", "aXbYbZ"));
  EXPECT_FALSE(matches("?", ""));
  EXPECT_FALSE(matches("", "a"));
  EXPECT_TRUE(matches("", ""));
}

/// By its definition, in exponential time.
bool matchesByDefinition(const std::string& pattern, const std::string& name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] == '*')
    return matchesByDefinition(pattern.substr(1), name) ||
           (!name.empty() && matchesByDefinition(pattern, name.substr(1)));
  return !name.empty() && (pattern[0] == '?' || pattern[0] == name[0]) &&
         matchesByDefinition(pattern.substr(1), name.substr(1));
}

TEST(NamePattern, AsItIsDefined) {
  std::mt19937 random(1);
  const auto text = [&](const std::string& letters, std::size_t most) {
    std::string made;
    for (std::size_t k = random() % (most + 1); k > 0; --k) made += letters[random() % letters.size()];
    return made;
  };
  int matched = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string pattern = text("ab*?", 7), name = text("ab", 7);
    ASSERT_EQ(matches(pattern, name), matchesByDefinition(pattern, name)) << pattern << " " << name;
    matched += matches(pattern, name);
  }
  EXPECT_GT(matched, 2000);
}

TEST(NamePattern, HostileOnesTakeNoTime) {
  std::string pattern, name(10'000, 'a');
  for (int i = 0; i < 1000; ++i) pattern += "a*";
  EXPECT_FALSE(matches(pattern + "b", name));
}

SceneDescription sceneOf(const std::vector<std::string>& names) {
  SceneDescription scene;
  for (const std::string& name : names) scene.bodies.emplace_back().name = name;
  return scene;
}

std::string reasonOf(const SceneDescription& scene, const std::string& a, const std::string& b) {
  for (const PairDecision& pair : scene.allowed)
    if ((pair.body_a == a && pair.body_b == b) || (pair.body_a == b && pair.body_b == a)) return pair.text;
  return "";
}

TEST(PairRules, LeaveOutAndTakeBack) {
  SceneDescription scene = sceneOf({"finger_1", "finger_2", "part", "table", "base"});
  scene.allowed = {{"part", "base", "SRDF: Never"}};
  PairRules rules;
  rules.allowed = {{"finger_*", "part"}, {"*", "table"}, {"base", "part"}};
  rules.checked = {{"table", "finger_2"}, {"base", "*"}};
  std::vector<std::string> warnings;
  applyRules(rules, scene, warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(reasonOf(scene, "finger_1", "part"), "allowed_pairs: finger_* - part");
  EXPECT_EQ(reasonOf(scene, "finger_2", "part"), "allowed_pairs: finger_* - part");
  EXPECT_EQ(reasonOf(scene, "part", "table"), "allowed_pairs: * - table");
  EXPECT_EQ(reasonOf(scene, "table", "finger_2"), "") << "checked wins";
  EXPECT_EQ(reasonOf(scene, "part", "base"), "") << "also over an SRDF";
  EXPECT_EQ(reasonOf(scene, "finger_1", "finger_2"), "");
  EXPECT_EQ(scene.allowed.size(), 4u);
}

TEST(PairRules, NamesThatNobodyHasAreTold) {
  SceneDescription scene = sceneOf({"finger", "table"});
  std::vector<std::string> warnings;
  applyRules({{{"fingr", "table"}}, {{"x*", "table"}}}, scene, warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("allowed_pairs: no body is named fingr"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("finger"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("checked_pairs: no body is named x*"), std::string::npos) << warnings[1];
  EXPECT_TRUE(scene.allowed.empty());
}

}  // namespace sdf_ccd::pair_rules_test
