#include "robot_monitor/overlapping_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "scene/name_pair.h"
#include "sdf_ccd/body.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::overlapping_pairs_test {

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
    RobotPairOptions options;
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

/// A depth in millimetres, after "name ("; negative without one.
double depthAfter(const std::string& begin, const std::string& text) {
  const std::size_t at = text.find(begin);
  return at == std::string::npos ? -1.0 : std::stod(text.substr(at + begin.size()));
}

/// Those of the pairs that the rule sets aside, or not.
std::set<std::string> namesOf(bool set_aside, const std::vector<PairDecision>& pairs) {
  std::set<std::string> names;
  for (const PairDecision& pair : pairs)
    if (!pair.text.empty() == set_aside) names.insert(pair.body_a + " " + pair.body_b);
  return names;
}

using Names = std::set<std::string>;

/// The arm hangs in the base, and swings out of it; nobody knows where the ghost goes. The hanging arm ends where the
/// ghost begins.
TEST(OverlappingPairs, EachRuleSetsItsOwnAside) {
  const Names all = {"base wheel", "base arm", "base ghost", "ghost arm"};
  const std::map<OverlapRule::Kind, Names> expected = {{OverlapRule::Kind::kNeighbours, {"base wheel", "base arm"}},
                                                       {OverlapRule::Kind::kLeaveOut, {"base wheel"}},
                                                       {OverlapRule::Kind::kRest, all},
                                                       {OverlapRule::Kind::kCheck, {}}};
  for (const auto& [kind, names] : expected) {
    Cart cart;
    const std::vector<PairDecision> found = applyOverlapRule(cart.robot, {kind, {}}, cart.scene);
    EXPECT_EQ(namesOf(true, found), names) << int(kind);
    Names checked = all;
    for (const std::string& name : names) checked.erase(name);
    EXPECT_EQ(namesOf(false, found), checked) << int(kind);
    for (const std::string& name : all) EXPECT_EQ(cart.has(name), checked.count(name) > 0) << name;
    for (const PairDecision& pair : found) {
      const bool is_open = pair.body_b == "arm" && pair.body_a == "ghost";
      const bool is_always = kind == OverlapRule::Kind::kLeaveOut && pair.body_b == "wheel";
      EXPECT_EQ(pair.kind, is_open     ? PairKind::kMayAtRest
                           : is_always ? PairKind::kAlways
                                       : PairKind::kAtRest)
          << pair.body_b;
      if (pair.body_b == "wheel") {
        EXPECT_NEAR(pair.depth, 0.03, 0.002);
      }
      if (pair.body_b == "arm" && !is_open) {
        EXPECT_NEAR(pair.depth, 0.05, 0.01);
      }
    }
  }
}

/// `far`, on as many hinges in a row as given, is 5 cm inside the base at rest; it swings out of it.
std::string folded(int hinges, const std::string& type = "continuous") {
  std::string urdf = "<robot name='folded'>" + box("base", "1 1 0.2"), last = "base";
  for (int i = 1; i < hinges; ++i) {
    const std::string link = "l" + std::to_string(i);
    urdf += box(link, "0.01 0.01 0.01", "0 5 0") + joint(last, link, type, "0 0 0.5");
    last = link;
  }
  const std::string down = std::to_string(-0.5 * (hinges - 1) + 0.5);
  return urdf + box("far", "0.05 0.05 0.45", "0 0 -0.225") + joint(last, "far", "continuous", "0 0 " + down) +
         "</robot>";
}

TEST(OverlappingPairs, OfFarLinksStayUnlessTheyAlwaysOverlap) {
  const auto setAside = [](const std::string& urdf) {
    const RobotModel robot(urdf);
    std::vector<std::string> warnings;
    const SceneDescription description = describeRobot(robot, {}, noResource, {}, warnings);
    Scene scene = buildScene(description, planScene(description), coarse());
    const std::vector<PairDecision> found = applyOverlapRule(robot, {}, scene);
    EXPECT_EQ(namesOf(true, found).size() + namesOf(false, found).size(), 1U);
    return namesOf(true, found);
  };
  EXPECT_EQ(setAside(folded(2)), Names{"base far"});
  EXPECT_EQ(setAside(folded(3)), Names{});
  EXPECT_EQ(setAside(folded(2, "floating")), Names{}) << "nobody knows where it goes";
}

TEST(OverlappingPairs, AreToldWithLinesForAnSrdf) {
  Cart cart;
  const std::size_t before = cart.scene.pairs.size(), left_out = cart.scene.left_out.size();
  const std::vector<PairDecision> found = applyOverlapRule(cart.robot, {}, cart.scene);
  EXPECT_EQ(cart.scene.pairs.size(), before - 2);
  ASSERT_EQ(cart.scene.left_out.size(), left_out + 2);
  const PairDecision& last = cart.scene.left_out.back();
  EXPECT_EQ(last.text, "overlap at rest, with at most two movable joints between them, which is no proof for others");
  EXPECT_GT(last.depth, 0.02);
  const OverlapNotes notes = overlapNotes(found, {}, cart.scene);
  ASSERT_EQ(cart.scene.overlap_notes, (std::vector<std::string>{notes.set_aside, notes.checked}));
  EXPECT_EQ(notes.set_aside.find("2 pairs that overlap at rest are set aside: base - arm ("), 0U);
  EXPECT_EQ(notes.checked.find("2 pairs that overlap at rest are checked: base - ghost ("), 0U);
  EXPECT_NE(notes.checked.find("ghost - arm (may overlap)\n"), std::string::npos) << notes.checked;
  EXPECT_NE(planTable(cart.scene).find(notes.set_aside), std::string::npos);

  // With these lines nothing is left to be told.
  std::string lines;
  for (const std::string& note : cart.scene.overlap_notes) lines += note.substr(note.find("\n<"));
  const Srdf srdf = parseSrdf("<robot name='cart'>" + lines + "</robot>");
  EXPECT_EQ(srdf.disabled.size(), 4U);
  std::vector<std::string> warnings;
  const SceneDescription description = describeRobot(cart.robot, srdf, noResource, {}, warnings);
  Scene scene = buildScene(description, planScene(description), coarse());
  EXPECT_TRUE(applyOverlapRule(cart.robot, {}, scene).empty());
  EXPECT_TRUE(scene.overlap_notes.empty());
  EXPECT_EQ(scene.pairs.size(), before - 4);
}

TEST(OverlappingPairs, ThoseThatTheUserNamesStay) {
  Cart cart;
  const OverlapRule rule{OverlapRule::Kind::kRest, {{"wh*", "base"}}};
  const std::vector<PairDecision> found = applyOverlapRule(cart.robot, rule, cart.scene);
  EXPECT_TRUE(cart.has("base wheel"));
  const std::string told = overlapNotes(found, rule, cart.scene).checked;
  EXPECT_NEAR(depthAfter("1 pair that overlaps at rest is checked: base - wheel (", told), 30.0, 2.0) << told;
  EXPECT_EQ(told.find("disable_collisions"), std::string::npos) << told;
}

/// What requests change is told as it then is: one has the arm checked, and the ghost left out.
TEST(OverlappingPairs, AreToldAsAnotherVersionHasThem) {
  Cart cart;
  const std::vector<PairDecision> found = applyOverlapRule(cart.robot, {}, cart.scene);
  Scene next = Cart().scene;
  std::vector<PairDecision> left_out;
  for (PairDecision pair : found) {
    if (pair.body_b != "wheel" && pair.body_b != "ghost") continue;
    if (pair.body_b == "ghost") pair.kind = PairKind::kRequest;
    left_out.push_back(pair);
  }
  leaveOut(left_out, next);
  const OverlapNotes notes = overlapNotes(found, {}, next);
  EXPECT_EQ(notes.set_aside.find("1 pair that overlaps at rest is set aside: base - wheel ("), 0U) << notes.set_aside;
  EXPECT_EQ(notes.checked.find("2 pairs that overlap at rest are checked: base - arm ("), 0U) << notes.checked;
  EXPECT_NE(notes.checked.find("ghost - arm"), std::string::npos) << notes.checked;
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
  applyOverlapRule(robot, {OverlapRule::Kind::kLeaveOut, {}}, scene);
  const std::string table = planTable(scene);
  EXPECT_NE(table.find("  7 pairs, overlap at rest and overlap or"), std::string::npos) << table;
  const std::string lines = table.substr(table.find("left out:"));
  for (int i = 0; i < 7; ++i) {
    const double depth = 10.0 + 5.0 * i;  // [mm]
    const std::string pair = "base - wheel" + std::to_string(i);
    EXPECT_NEAR(depthAfter(pair + " (", lines), depth, 0.5) << lines;
    const auto left_out = std::find_if(scene.left_out.begin(), scene.left_out.end(), [&](const PairDecision& entry) {
      return pairName(entry.body_a, entry.body_b) == pair;
    });
    ASSERT_NE(left_out, scene.left_out.end()) << pair;
    EXPECT_NEAR(1e3 * left_out->depth, depth, 0.5);
  }
  ASSERT_EQ(scene.overlap_notes.size(), 1U);
  const std::string& note = scene.overlap_notes[0];
  const std::string told = note.substr(0, note.find('\n'));
  EXPECT_NE(told.find("set aside: base - wheel6"), std::string::npos) << told;
  EXPECT_NE(told.find(" and 1 more"), std::string::npos) << told;
  EXPECT_EQ(told.find("wheel0"), std::string::npos) << told;
  EXPECT_NE(note.find("link2=\"wheel0\" reason=\"Always\"/>"), std::string::npos) << note;
}

/// Bodies of a robot between which are only links without shapes, as "a b", that stay.
std::set<std::string> checkedPairs(const std::string& urdf) {
  const RobotModel robot(urdf);
  std::vector<std::string> warnings;
  const SceneDescription description = describeRobot(robot, {}, binWithoutTop, {}, warnings);
  Scene scene = buildScene(description, planScene(description), coarse());
  applyOverlapRule(robot, {OverlapRule::Kind::kLeaveOut, {}}, scene);
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

/// Tested at rest alone, a carriage on its rail is not known to overlap it, nor to stay with it.
TEST(OverlappingPairs, NeighboursThatTouchAtRestAreToldAsSuch) {
  const RobotModel robot("<robot name='slide'>" + box("rail", "6 0.1 0.1") + "<link name='motor'/>" +
                         joint("rail", "motor", "fixed", "0 0 0") + box("car", "0.2 0.1 0.1", "0 0 0.1") +
                         joint("motor", "car", "prismatic", "0 0 0", "1 0 0") + "</robot>");
  std::vector<std::string> warnings;
  const SceneDescription description = describeRobot(robot, {}, noResource, {}, warnings);
  Scene scene = buildScene(description, planScene(description), coarse());
  const std::vector<PairDecision> found = applyOverlapRule(robot, {OverlapRule::Kind::kRest, {}}, scene);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, PairKind::kHeldAtRest);
  const std::string told = scene.overlap_notes.at(0);
  EXPECT_NE(told.find("rail - car (within 1 mm)"), std::string::npos) << told;
  EXPECT_NE(told.find("reason=\"Default\""), std::string::npos) << told;
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
    EXPECT_EQ(scene.overlap_notes.size(), scene.pairs.empty() ? 1U : 0U) << "at rest it is CLEAR";
    if (scene.pairs.empty()) {
      EXPECT_NE(scene.overlap_notes.at(0).find("rail - car (within 1 mm)"), std::string::npos)
          << scene.overlap_notes[0];
      EXPECT_EQ(scene.left_out.back().kind, PairKind::kHeld);
    }
    return scene.pairs.size();
  };
  EXPECT_EQ(pairsOf(0.7), 1U);  // the car's front reaches 1.1 m
  EXPECT_EQ(pairsOf(2.0), 0U);
}

/// Two shapes on sliders. All of their surfaces coincide, so that no point of one is inside the other.
TEST(OverlappingPairs, CopiesOfALinkMayOverlap) {
  const RobotModel robot("<robot name='sliders'>" + box("base", "0.01 0.01 0.01", "0 0 9") + box("a", "1 1 1") +
                         box("b", "1 1 1") + joint("base", "a", "prismatic", "0 0 0") +
                         joint("base", "b", "prismatic", "0 0 0") + "</robot>");
  std::vector<std::string> warnings;
  const SceneDescription description = describeRobot(robot, {}, noResource, {}, warnings);
  for (const OverlapRule::Kind kind : {OverlapRule::Kind::kNeighbours, OverlapRule::Kind::kRest}) {
    Scene scene = buildScene(description, planScene(description), optionsForContacts());
    const std::vector<PairDecision> found = applyOverlapRule(robot, {kind, {}}, scene);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].kind, PairKind::kMayAtRest);
    EXPECT_EQ(scene.pairs.empty(), kind == OverlapRule::Kind::kRest) << "nothing shows that they surely overlap";
  }
}

/// A capsule in a wall is as deep as its parts' union; beside it it is clear.
TEST(OverlappingPairs, OfCapsules) {
  const auto verdict = [](double x) {
    const RobotModel robot(
        "<robot name='r'>" + box("wall", "0.2 2 2") +
        "<link name='arm'><collision><origin rpy='0 1.5707963267948966 0'/><geometry><capsule radius='0.1' "
        "length='0.6'/></geometry></collision></link>" +
        joint("wall", "arm", "floating", std::to_string(x) + " 0 0") + "</robot>");
    std::vector<std::string> warnings;
    const SceneDescription description = describeRobot(robot, {}, noResource, {}, warnings);
    Scene scene = buildScene(description, planScene(description), coarse());
    const std::vector<PairDecision> found = applyOverlapRule(robot, {}, scene);
    return found.empty() ? -1.0 : found[0].depth;
  };
  EXPECT_EQ(verdict(0.5005), -1.0) << "its end is half a millimetre from the wall";
  EXPECT_GT(verdict(0.499), 0.0);
  EXPECT_GT(verdict(0.45), 0.03);
}

}  // namespace sdf_ccd::overlapping_pairs_test
