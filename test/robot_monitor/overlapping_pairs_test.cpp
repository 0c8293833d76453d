#include "robot_monitor/overlapping_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "model/name_pair.h"
#include "sdf_ccd/body/prepare_body.h"
#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd {
namespace {

Resource noResource(const std::string& uri) {
  throw std::runtime_error("no " + uri);
}

/// A box of 0.6 x 0.6 x 0.4 m without its top.
Resource binWithoutTop(const std::string&) {
  return {
      "v -0.3 -0.3 -0.2\nv 0.3 -0.3 -0.2\nv 0.3 0.3 -0.2\nv -0.3 0.3 -0.2\n"
      "v -0.3 -0.3 0.2\nv 0.3 -0.3 0.2\nv 0.3 0.3 0.2\nv -0.3 0.3 0.2\n"
      "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
      "bin.obj", ""};
}

std::string box(const std::string& link, const std::string& size, const std::string& xyz = "0 0 0") {
  return "<link name='" + link + "'><collision><origin xyz='" + xyz + "'/><geometry><box size='" + size +
         "'/></geometry></collision></link>";
}

std::string joint(const std::string& parent, const std::string& child, const std::string& type, const std::string& xyz,
                  const std::string& axis = "0 1 0") {
  return "<joint name='to_" + child + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/><origin xyz='" + xyz + "'/><axis xyz='" + axis +
         "'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>";
}

/// A base 0.2 m high on a caster, with a wheel that reaches 3 cm into the base at all joint positions; an arm that is
/// in the base while it hangs down; and a body that floats in the base.
std::string cart() {
  return "<robot name='cart'>" + box("base", "1 1 0.2") +                                                    //
         box("caster", "0.02 0.02 0.02") + joint("base", "caster", "continuous", "0 0 -0.15", "0 0 1") +     //
         "<link name='wheel'><collision><geometry><sphere radius='0.08'/></geometry></collision></link>" +   //
         joint("caster", "wheel", "continuous", "0 0 0") +                                                   //
         box("mast", "0.02 0.02 0.02", "0 0 0.5") + joint("base", "mast", "continuous", "0 0 0", "0 0 1") +  //
         box("arm", "0.05 0.05 0.45", "0 0 -0.225") + joint("mast", "arm", "continuous", "0 0 0.5") +        //
         box("ghost", "0.1 0.1 0.1") + joint("caster", "ghost", "floating", "0 0 0.15") + "</robot>";
}

BodyOptions coarse() {
  BodyOptions options;
  options.field.cells = 32;
  options.shell.spacing = 0.01;
  return options;
}

struct Cart {
  RobotModel robot{cart()};
  Scene scene;

  explicit Cart(bool check_adjacent = false) {
    RobotSceneOptions options;
    options.check_adjacent = check_adjacent;
    std::vector<std::string> warnings;
    const SceneDescription description = describeRobot(robot, {}, noResource, options, warnings);
    scene = buildScene(description, planScene(description), coarse());
  }

  std::string nameOf(int pair) const {
    const PlannedPair& planned = scene.pairs[static_cast<std::size_t>(pair)];
    return scene.bodies[planned.body_a].name + " " + scene.bodies[planned.body_b].name;
  }
  bool has(const std::string& name) const {
    for (std::size_t p = 0; p < scene.pairs.size(); ++p)
      if (nameOf(static_cast<int>(p)) == name) return true;
    return false;
  }
};

TEST(OverlappingPairs, ThoseAtRestAndWhetherAlways) {
  const Cart cart;
  std::map<std::string, OverlappingPair> found;
  for (const OverlappingPair& pair : overlappingPairs(cart.robot, cart.scene)) found[cart.nameOf(pair.pair)] = pair;
  ASSERT_EQ(found.count("base wheel"), 1u);
  EXPECT_TRUE(found["base wheel"].always);
  EXPECT_NEAR(found["base wheel"].depth, 0.03, 0.002);
  ASSERT_EQ(found.count("base arm"), 1u);
  EXPECT_FALSE(found["base arm"].always) << "it hangs in the base, and swings out of it";
  EXPECT_NEAR(found["base arm"].depth, 0.05, 0.01);
  ASSERT_EQ(found.count("base ghost"), 1u);
  EXPECT_FALSE(found["base ghost"].always) << "nobody knows where it goes";
}

/// A depth in millimetres, after "name ("; negative without one.
double depthAfter(const std::string& begin, const std::string& text) {
  const std::size_t at = text.find(begin);
  return at == std::string::npos ? -1.0 : std::stod(text.substr(at + begin.size()));
}

TEST(OverlappingPairs, AreLeftOutAndTold) {
  Cart cart;
  const std::size_t before = cart.scene.pairs.size();
  const std::size_t left_out = cart.scene.left_out.size();
  applyOverlapRule(cart.robot, {}, cart.scene);
  EXPECT_EQ(cart.scene.pairs.size(), before - 1);
  EXPECT_FALSE(cart.has("base wheel"));
  EXPECT_TRUE(cart.has("base arm"));
  ASSERT_EQ(cart.scene.left_out.size(), left_out + 1);
  EXPECT_EQ(cart.scene.left_out.back().what(), "pair base - wheel");
  const LeftOutReason reason = cart.scene.left_out.back().reason;
  EXPECT_NEAR(reason.depth, 0.03, 0.002);
  EXPECT_EQ(reason.text,
            "overlap at rest and overlap or, as neighbours, come within 1 mm in all of 200 random states, which is no "
            "proof for others");
  ASSERT_EQ(cart.scene.warnings.size(), 3u);
  EXPECT_NE(cart.scene.warnings[0].find("base - wheel (30 mm)"), std::string::npos) << cart.scene.warnings[0];
  EXPECT_NE(cart.scene.warnings[1].find("base - arm"), std::string::npos) << cart.scene.warnings[1];
  // The hanging arm ends where the ghost begins.
  EXPECT_EQ(cart.scene.warnings[2],
            "may overlap where all joints are at rest, as far as can be told, and are checked: 1 pair of links: "
            "ghost - arm");
  EXPECT_NE(planTable(cart.scene).find(cart.scene.warnings[0]), std::string::npos);
  const std::string table = planTable(cart.scene);
  EXPECT_NEAR(depthAfter("random states, which is no proof for others: base - wheel (", table), 30.0, 2.0) << table;
  std::size_t counted = 0;
  for (const BodyReport& report : cart.scene.reports) counted += report.pairs;
  EXPECT_EQ(counted, 2 * cart.scene.pairs.size());
  EXPECT_GT(cart.scene.contact_bound.total(), 0.0);
}

TEST(OverlappingPairs, ThoseThatStayAreToldToo) {
  for (const OverlapRule& rule : {OverlapRule{true, {{"wh*", "base"}}}, OverlapRule{false, {}}}) {
    Cart cart;
    const std::size_t before = cart.scene.pairs.size();
    applyOverlapRule(cart.robot, rule, cart.scene);
    EXPECT_EQ(cart.scene.pairs.size(), before);
    EXPECT_TRUE(cart.has("base wheel"));
    std::string told;
    for (const std::string& warning : cart.scene.warnings) told += warning + "\n";
    EXPECT_NEAR(depthAfter("base - wheel (", told), 30.0, 2.0) << told;
    EXPECT_NEAR(depthAfter("base - arm (", told), 50.0, 10.0) << told;
    EXPECT_EQ(told.find("as checked_pairs") != std::string::npos, rule.leave_out) << told;
  }
}

/// Seven wheels in a base, each 5 mm deeper than the one before, on casters so that they are not adjacent.
TEST(OverlappingPairs, AllHaveTheirDepthInThePlanAndTheDeepestAreNamed) {
  std::string urdf = "<robot name='truck'>" + box("base", "2.4 0.3 0.2");
  for (int i = 0; i < 7; ++i) {
    const std::string n = std::to_string(i);
    urdf += box("caster" + n, "0.02 0.02 0.02") +
            joint("base", "caster" + n, "continuous",
                  std::to_string(0.3 * (i - 3)) + " 0 " + std::to_string(0.005 * i - 0.16), "0 0 1") +
            "<link name='wheel" + n + "'><collision><geometry><sphere radius='0.07'/></geometry></collision></link>" +
            joint("caster" + n, "wheel" + n, "continuous", "0 0 0");
  }
  const RobotModel robot(urdf + "</robot>");
  std::vector<std::string> warnings;
  const SceneDescription description = describeRobot(robot, {}, noResource, {}, warnings);
  Scene scene = buildScene(description, planScene(description), coarse());
  applyOverlapRule(robot, {}, scene);
  const std::string table = planTable(scene);
  EXPECT_NE(table.find("  7 pairs, overlap at rest and overlap or"), std::string::npos) << table;
  const std::string lines = table.substr(table.find("left out:"));
  for (int i = 0; i < 7; ++i) {
    const double depth = 10.0 + 5.0 * i;  // [mm]
    const std::string pair = "base - wheel" + std::to_string(i);
    EXPECT_NEAR(depthAfter(pair + " (", lines), depth, 0.5) << lines;
    const auto left_out = std::find_if(scene.left_out.begin(), scene.left_out.end(),
                                       [&](const LeftOut& entry) { return entry.what() == "pair " + pair; });
    ASSERT_NE(left_out, scene.left_out.end()) << pair;
    EXPECT_NEAR(1e3 * left_out->reason.depth, depth, 0.5);
  }
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("the deepest first: base - wheel6"), std::string::npos) << scene.warnings[0];
  EXPECT_EQ(scene.warnings[0].find("wheel0"), std::string::npos) << scene.warnings[0];
}

/// Bodies of a robot between which are only links without shapes, as "a b", that stay.
std::set<std::string> checkedPairs(const std::string& urdf) {
  const RobotModel robot(urdf);
  std::vector<std::string> warnings;
  const SceneDescription description = describeRobot(robot, {}, binWithoutTop, {}, warnings);
  Scene scene = buildScene(description, planScene(description), coarse());
  applyOverlapRule(robot, {}, scene);
  std::set<std::string> names;
  for (const PlannedPair& pair : scene.pairs)
    names.insert(scene.bodies[pair.body_a].name + " " + scene.bodies[pair.body_b].name);
  return names;
}

/// On a base without a shape, an arm turns on the chassis, which it touches, and through the mast.
TEST(OverlappingPairs, OnlyWhatAlwaysTouchesIsLeftOutBesideAJoint) {
  EXPECT_EQ(checkedPairs("<robot name='turret'><link name='base'/>" + box("chassis", "1 1 0.1", "0 0 0.05") +
                         joint("base", "chassis", "fixed", "0 0 0") + box("mast", "0.05 0.05 1", "0 0 0.5") +
                         joint("base", "mast", "fixed", "0.4 0 0.1") + box("arm", "0.5 0.05 0.05", "0.25 0 0") +
                         joint("base", "arm", "continuous", "0 0 0.125", "0 0 1") + "</robot>"),
            std::set<std::string>({"arm mast"}));
}

/// Fingers 0 to 10 mm apart, and 10 mm from the palm, on an arm so large that its contacts have a bound of 22 mm.
TEST(OverlappingPairs, OfSmallLinksOnALargeRobotStayToo) {
  const std::string limits = "'><limit lower='-0.001' upper='0.005' effort='1' velocity='1'/>";
  const auto finger = [&](const std::string& name, double side) {
    const std::string y = std::to_string(side);
    return box(name, "0.01 0.01 0.04", "0 " + std::to_string(0.005 * side) + " 0.025") + "<joint name='j_" + name +
           "' type='prismatic" + limits + "<parent link='palm'/><child link='" + name + "'/><axis xyz='0 " + y +
           " 0'/></joint>";
  };
  const std::set<std::string> checked =
      checkedPairs("<robot name='gripper'>" + box("base", "0.8 0.15 0.15", "0.4 0 0") + "<link name='palm'/>" +
                   joint("base", "palm", "revolute", "0.85 0 0") + box("shell", "0.02 0.06 0.03", "0 0 -0.02") +
                   joint("palm", "shell", "fixed", "0 0 0") + finger("left", 1.0) + finger("right", -1.0) + "</robot>");
  EXPECT_EQ(checked.count("left right") + checked.count("right left"), 1u);
  EXPECT_EQ(checked.count("left shell") + checked.count("shell left"), 1u);
}

/// An arm turns in a bin of sheet metal, through whose walls it comes at the end.
TEST(OverlappingPairs, NeighboursInOpenMeshesStay) {
  const std::set<std::string> checked = checkedPairs(
      "<robot name='picker'><link name='base'/><link name='bin'><collision><geometry><mesh "
      "filename='bin.obj'/></geometry></collision></link>" +
      joint("base", "bin", "fixed", "0 0 0") + box("arm", "0.02 0.02 0.05") +
      joint("base", "arm", "continuous", "0 0 0", "0 0 1") + "</robot>");
  EXPECT_EQ(checked, std::set<std::string>({"arm bin"}));
}

TEST(OverlappingPairs, AdjacentOnesThatAreCheckedStay) {
  Cart cart(true);
  applyOverlapRule(cart.robot, {}, cart.scene);
  EXPECT_TRUE(cart.has("caster wheel")) << "they overlap always, but are checked by request";
  EXPECT_FALSE(cart.has("base wheel"));
}

/// A carriage 0.5 mm above its rail, with a link without a shape between: what it does to the rail's stop must be
/// checked.
TEST(OverlappingPairs, NeighboursThatTouchAndHitAStopStay) {
  const auto pairsOf = [](double stop) {  // where the stop begins, along the rail
    const std::string rail =
        "<link name='rail'><collision><geometry><box size='6 0.1 0.1'/></geometry></collision>"
        "<collision><origin xyz='" +
        std::to_string(stop + 0.1) + " 0 0.1'/><geometry><box size='0.2 0.1 0.1'/></geometry></collision></link>";
    const RobotModel robot("<robot name='slide'>" + rail + "<link name='motor'/>" +
                           joint("rail", "motor", "fixed", "0 0 0") + box("car", "0.2 0.1 0.1", "0 0 0.1005") +
                           joint("motor", "car", "prismatic", "0 0 0", "1 0 0") + "</robot>");
    std::vector<std::string> warnings;
    const SceneDescription description = describeRobot(robot, {}, noResource, {}, warnings);
    Scene scene = buildScene(description, planScene(description), coarse());
    applyOverlapRule(robot, {}, scene);
    EXPECT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings.at(0).find("rail - car (within 1 mm)"), std::string::npos) << scene.warnings[0];
    if (scene.pairs.empty()) {
      EXPECT_EQ(scene.left_out.back().reason.text.find("come within 1 mm as neighbours at rest, and"), 0U);
    }
    return scene.pairs.size();
  };
  EXPECT_EQ(pairsOf(0.7), 1U);  // the car's front reaches 1.1 m
  EXPECT_EQ(pairsOf(2.0), 0U);
}

/// Two shapes on sliders, with a shape on a third link between them that touches neither.
std::vector<OverlappingPair> overlapOf(const std::string& first, const std::string& second, std::string& name) {
  const RobotModel robot("<robot name='sliders'>" + box("base", "0.01 0.01 0.01", "0 0 9") + first + second +
                         joint("base", "a", "prismatic", "0 0 0") + joint("base", "b", "prismatic", "0 0 0") +
                         "</robot>");
  std::vector<std::string> warnings;
  const SceneDescription description = describeRobot(robot, {}, noResource, {}, warnings);
  const Scene scene = buildScene(description, planScene(description), optionsForContacts());
  std::vector<OverlappingPair> found = overlappingPairs(robot, scene, 0);
  for (const OverlappingPair& pair : found) name = pairName(scene, scene.pairs[std::size_t(pair.pair)]);
  return found;
}

/// All of their surfaces coincide, so that no point of one is inside the other.
TEST(OverlappingPairs, CopiesOfALinkMayOverlap) {
  std::string name;
  const std::vector<OverlappingPair> found = overlapOf(box("a", "1 1 1"), box("b", "1 1 1"), name);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().overlap, Overlap::kOpen);
  EXPECT_EQ(name, "a - b");
}

}  // namespace
}  // namespace sdf_ccd
