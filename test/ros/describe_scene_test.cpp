#include "ros/world/describe_scene.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "oracle/failure.h"

namespace sdf_ccd::describe_scene_test {

/// A base that holds a wheel on a caster, and a table beside it.
MonitorParameters cart() {
  MonitorParameters parameters = parseParameters({}, "~");
  parameters.urdf = R"(<robot name="cart">
    <link name="base"><collision><geometry><box size="1 1 0.2"/></geometry></collision></link>
    <link name="caster"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
    <link name="wheel"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="swivel" type="continuous"><parent link="base"/><child link="caster"/><axis xyz="0 0 1"/></joint>
    <joint name="roll" type="continuous"><parent link="caster"/><child link="wheel"/><axis xyz="0 1 0"/></joint>
    </robot>)";
  parameters.scene.cache_directory.clear();
  parameters.scene.field.cell_size = std::nullopt;
  parameters.scene.field.cells = 16;
  parameters.scene.shell.spacing = 0.05;
  WorldObject table;
  table.name = "table";
  table.frame = "elsewhere";
  table.shapes = {{Primitive(Box::fromSize({0.6, 0.6, 0.6}))}};
  parameters.world.push_back(table);
  return parameters;
}

std::set<std::string> pairsOf(const MonitorParameters& parameters, std::vector<std::string>* left_out = nullptr,
                              std::vector<std::string>* warnings = nullptr) {
  DescribedScene described = describeScene(parameters, [](const std::string&) { return Resource(); });
  const ScenePlan plan = planScene(described.scene, planOptions(parameters.scene));
  const std::shared_ptr<const Scene> scene = buildDescribed(described, plan, parameters.scene, {});
  std::set<std::string> pairs;
  for (const PlannedPair& pair : scene->pairs)
    pairs.insert(scene->bodies[pair.body_a].name + " " + scene->bodies[pair.body_b].name);
  if (left_out)
    for (const PairDecision& pair : scene->left_out)
      left_out->push_back(pair.body_a + " - " + pair.body_b + ": " + pair.text);
  if (warnings) *warnings = scene->overlap_notes;
  return pairs;
}

TEST(DescribeScene, LinksOfOneFrameAreRefused) {
  MonitorParameters parameters = cart();
  const auto failure = [&] {
    return test::failureOf([&] { describeScene(parameters, [](const std::string&) { return Resource(); }); });
  };
  const auto rename = [&](const std::string& from, const std::string& to) {
    for (std::size_t at; (at = parameters.urdf.find('"' + from + '"')) != std::string::npos;)
      parameters.urdf.replace(at + 1, from.size(), to);
  };
  rename("wheel", "/wheel");
  EXPECT_EQ(failure(), "");
  rename("caster", "wheel");
  EXPECT_EQ(failure(), "the links wheel and /wheel have the same tf frame, wheel");
  parameters.tf_prefix = "cart";
  EXPECT_EQ(failure(), "") << "as frames, they differ";
}

TEST(DescribeScene, NamesOfALiveMapsTilesAreItsOwn) {
  const auto failureOf = [](const MonitorParameters& parameters) {
    return test::failureOf<std::invalid_argument>(
        [&] { describeScene(parameters, [](const std::string&) { return Resource(); }); });
  };
  MonitorParameters parameters = cart();
  parameters.world[0].name = "octomap/1_2_3";
  EXPECT_EQ(failureOf(parameters), "");
  parameters.live_map.topic = "/octomap";
  EXPECT_NE(failureOf(parameters).find("octomap/1_2_3: names that begin with octomap/"), std::string::npos);
  parameters.world[0].name = "octomap";
  EXPECT_EQ(failureOf(parameters), "");
}

TEST(DescribeScene, ObjectsHaveNoNamesThatPatternsOrFilesMistake) {
  MonitorParameters parameters = cart();
  for (const char* name : {"tab*", "table?", " table", "table "}) {
    parameters.world[0].name = name;
    const std::string failure = test::failureOf<std::invalid_argument>(
        [&] { describeScene(parameters, [](const std::string&) { return Resource(); }); });
    EXPECT_NE(failure.find("a name must not"), std::string::npos) << name << ": " << failure;
  }
}

TEST(DescribeScene, TheNumberOfObjectsIsLimited) {
  MonitorParameters parameters = cart();
  const WorldObject table = parameters.world[0];
  while (parameters.world.size() <= kMaxObjects) {
    parameters.world.push_back(table);
    parameters.world.back().name += std::to_string(parameters.world.size());
  }
  const auto describe = [&] { describeScene(parameters, [](const std::string&) { return Resource(); }); };
  EXPECT_EQ(test::failureOf<std::invalid_argument>(describe), "world: 5001 objects; at most 5000 are allowed");
  parameters.world.pop_back();
  EXPECT_EQ(test::failureOf<std::invalid_argument>(describe), "");
}

TEST(DescribeScene, AResourceRootThatIsNotThereIsWarnedOf) {
  MonitorParameters parameters = cart();
  parameters.resource_roots = {"/tmp", "/tmp/no such folder"};
  const auto warnings = describeScene(parameters, [](const std::string&) { return Resource(); }).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("/tmp/no such folder"), std::string::npos) << warnings[0];
}

using Pairs = std::set<std::string>;

TEST(DescribeScene, LinksThatOverlapAtRestAreSetAsideByDefault) {
  std::vector<std::string> left_out;
  EXPECT_EQ(pairsOf(cart(), &left_out), (Pairs{"base table", "caster table", "wheel table"}));
  EXPECT_EQ(
      std::count_if(left_out.begin(), left_out.end(),
                    [](const std::string& pair) { return pair.rfind("base - wheel: overlap at rest, with ", 0) == 0; }),
      1);
}

TEST(DescribeScene, TheyAreCheckedAndToldIfThatIsWanted) {
  const auto expectChecked = [](const MonitorParameters& parameters) {
    std::vector<std::string> left_out, warnings;
    EXPECT_EQ(pairsOf(parameters, &left_out, &warnings),
              (Pairs{"base wheel", "base table", "caster table", "wheel table"}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("base - wheel ("), std::string::npos) << warnings[0];
  };
  MonitorParameters parameters = cart();
  parameters.overlapping_pairs = OverlapRule::Kind::kCheck;
  expectChecked(parameters);
  parameters = cart();
  parameters.pairs.checked = {{"wheel", "b*"}};
  expectChecked(parameters);
  parameters = cart();
  parameters.srdf = "<robot name='cart'><enable_collisions link1='wheel' link2='base'/></robot>";
  expectChecked(parameters);
}

TEST(DescribeScene, RulesHoldForObjectsToo) {
  MonitorParameters parameters = cart();
  parameters.pairs.allowed = {{"*", "table"}};
  parameters.pairs.checked = {{"wheel", "table"}};
  std::vector<std::string> left_out;
  EXPECT_EQ(pairsOf(parameters, &left_out), (Pairs{"wheel table"}));
  EXPECT_EQ(std::count(left_out.begin(), left_out.end(), "base - table: allowed_pairs: * - table"), 1);
}

}  // namespace sdf_ccd::describe_scene_test
