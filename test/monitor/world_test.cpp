#include "sdf_ccd/scene.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <thread>

#include "monitor/map/voxel_mask.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"

namespace sdf_ccd::world_test {

using namespace test;

BodyOptions coarse() {
  BodyOptions options = fine(0.03);
  options.field.cells = 12;
  return options;
}

ScenePlan planOf(const SceneDescription& description, const BodyOptions& options) {
  return planScene(description, planOptions(options));
}

/// A world of some links and objects that changes randomly.
class ChangingWorld {
 public:
  explicit ChangingWorld(unsigned seed) : random_(seed) {
    links_ = {body("link0", Primitive(Sphere{0.1})), body("link1", Primitive(Box::fromSize({0.2, 0.12, 0.1}))),
              body("link2", meshShape(torusMesh(0.12, 0.04, 16, 8)))};
    description_.bodies = links_;
    for (const char* link : {"link0", "link1", "link2"})
      before_[link] = moving_[link] = pose({uniform(random_, -0.5, 0.5), 0, 0}, 0, {0, 0, 1});
  }

  const SceneDescription& description() const { return description_; }

  /// Makes one to four changes: adds, removes, moves, attaches or detaches an object, or changes its allowed pairs.
  void change() {
    for (int n = 1 + int(uniform(random_, 0.0, 4.0)); n > 0; --n) changeOnce();
  }

  /// All bodies at rest: the links where they were before the last motion, or elsewhere.
  CycleMotion rest(bool elsewhere) {
    CycleMotion motion;
    motion.times = {0.0, 1.0};
    for (const BodyDescription& body : description_.bodies) {
      Isometry3d X_WF = body.frame == "world" ? Isometry3d::Identity() : before_.at(body.frame);
      if (elsewhere) X_WF = place();
      motion.X_WB.push_back({X_WF * body.X_frame_B});
    }
    return motion;
  }

  /// Poses over one cycle: links continue from their last poses, objects follow their frames.
  CycleMotion motion() {
    std::map<std::string, std::vector<Isometry3d>> frames;
    frames["world"] = still(Isometry3d::Identity());
    before_ = moving_;
    for (auto& [link, X] : moving_) {
      const Vector3d to(uniform(random_, -0.6, 0.6), uniform(random_, -0.6, 0.6), uniform(random_, -0.3, 0.3));
      const Vector3d shift = 0.15 * (to - X.translation());
      const Isometry3d next = pose(X.translation() + shift, 0.0, {0, 0, 1}) *
                              pose({0, 0, 0}, uniform(random_, -0.2, 0.2), direction(random_)) * Isometry3d(X.linear());
      frames[link] = {X, next};
      X = next;
    }
    CycleMotion motion;
    motion.times = {0.0, 0.1};
    for (const BodyDescription& body : description_.bodies) {
      motion.X_WB.emplace_back();
      for (const Isometry3d& X_WF : frames.at(body.frame)) motion.X_WB.back().push_back(X_WF * body.X_frame_B);
    }
    return motion;
  }

 private:
  BodyDescription object() {
    const int kind = int(uniform(random_, 0.0, 4.0));
    const std::string name = "object" + std::to_string(++objects_);
    const Shape shape = kind == 0   ? Shape(Primitive(Sphere{0.08}))
                        : kind == 1 ? Shape(Primitive(Box::fromSize({0.1, 0.16, 0.2})))
                        : kind == 2 ? Shape(Primitive(Cylinder::fromRadiusAndLength(0.05, 0.2)))
                                    : meshShape(torusMesh(0.1, 0.03, 12, 8));
    BodyDescription made = body(name, shape, true);
    made.X_frame_B = place();
    return made;
  }
  Isometry3d place() {
    return pose({uniform(random_, -0.8, 0.8), uniform(random_, -0.8, 0.8), uniform(random_, -0.4, 0.4)},
                uniform(random_, -3.0, 3.0), direction(random_));
  }
  BodyDescription& anyObject() {
    return description_.bodies[links_.size() + std::size_t(uniform(random_, 0.0, 0.999) *
                                                           double(description_.bodies.size() - links_.size()))];
  }
  void dropPairs(const std::string& name) {
    auto& allowed = description_.allowed;
    allowed.erase(std::remove_if(allowed.begin(), allowed.end(),
                                 [&](const PairDecision& pair) { return pair.body_a == name || pair.body_b == name; }),
                  allowed.end());
  }
  void changeOnce() {
    const std::size_t objects = description_.bodies.size() - links_.size();
    const int what = objects == 0 ? 0 : objects > 12 ? 1 : int(uniform(random_, 0.0, 6.0));
    if (what == 0) {
      description_.bodies.push_back(object());
      return;
    }
    BodyDescription& one = anyObject();
    if (what == 1) {
      dropPairs(one.name);
      const std::string name = one.name;
      auto& bodies = description_.bodies;
      bodies.erase(
          std::find_if(bodies.begin(), bodies.end(), [&](const BodyDescription& b) { return b.name == name; }));
    } else if (what == 2) {
      one.X_frame_B = place();
    } else if (what == 3) {  // attached
      one.is_world = false;
      one.frame = "link1";
      one.X_frame_B = pose({0.2, 0, 0}, 0.3, {0, 0, 1});
      dropPairs(one.name);
    } else if (what == 4) {
      one.is_world = true;
      one.frame = "world";
      one.X_frame_B = place();
    } else {
      dropPairs(one.name);
      if (uniform(random_, 0.0, 1.0) < 0.5) description_.allowed.push_back({"link0", one.name, "allowed"});
    }
  }

  Random random_;
  std::vector<BodyDescription> links_;
  SceneDescription description_;
  std::map<std::string, Isometry3d> moving_, before_;
  int objects_ = 0;
};

void expectSame(const CycleResult& changed, const CycleResult& anew, const Scene& scene, std::uint64_t version) {
  ASSERT_EQ(changed.pairs.size(), anew.pairs.size());
  for (std::size_t p = 0; p < anew.pairs.size(); ++p) {
    const std::string pair = scene.bodies[anew.pairs[p].body_a].name + " " + scene.bodies[anew.pairs[p].body_b].name +
                             " version " + std::to_string(version);
    ASSERT_EQ(changed.pairs[p].body_a, anew.pairs[p].body_a) << pair;
    ASSERT_EQ(changed.pairs[p].body_b, anew.pairs[p].body_b) << pair;
    ASSERT_EQ(changed.pairs[p].verdict, anew.pairs[p].verdict) << pair;
    ASSERT_EQ(changed.pairs[p].intervals.size(), anew.pairs[p].intervals.size()) << pair;
    for (std::size_t i = 0; i < anew.pairs[p].intervals.size(); ++i)
      ASSERT_NEAR(changed.pairs[p].intervals[i].enter, anew.pairs[p].intervals[i].enter, 1e-12) << pair;
    ASSERT_LT((changed.pairs[p].on_a_W.force - anew.pairs[p].on_a_W.force).norm(), 1e-6) << pair;
  }
  EXPECT_EQ(changed.verdict, anew.verdict);
}

/// Verdicts equal those of a new monitor of a scene that buildScene() makes of the same description, pair by pair.
TEST(World, ChangesAreAsAMonitorBuiltAnew) {
  const BodyOptions options = coarse();
  int contacts = 0, skipped = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    ChangingWorld world(seed);
    WorldEditor editor(options);
    const ScenePlan plan = planOf(world.description(), options);
    auto snapshot = editor.begin(world.description(), plan, buildScene(world.description(), plan, options));
    Monitor monitor(snapshot->scene, soft());
    for (int version = 2; version < 30; ++version) {
      world.change();
      snapshot = editor.next(world.description());
      ASSERT_EQ(snapshot->version, std::uint64_t(version));
      // Whatever pairs were tested in advance, near the poses of the next cycle or far from them.
      const CycleMotion likely = world.rest(version % 3 == 0);
      const auto change = monitor.prepare(snapshot->scene, version % 3 < 2 ? &likely : nullptr);
      monitor.adopt(*change);
      const auto anew =
          std::make_shared<const Scene>(buildScene(world.description(), planOf(world.description(), options), options));
      for (int cycle = 0; cycle < 3; ++cycle) {
        const CycleMotion motion = world.motion();
        CycleRequest request;
        request.skipped_pairs = version % 2 == 0;
        const CycleResult changed = monitor.run(motion, request);
        const CycleResult expected = Monitor(anew, soft()).run(motion, request);
        expectSame(changed, expected, *snapshot->scene, snapshot->version);
        if (HasFatalFailure()) return;
        contacts += changed.verdict == Verdict::kContact;
        skipped += changed.skipped;
      }
    }
  }
  EXPECT_GT(contacts, 20);
  EXPECT_GT(skipped, 150);
}

/// Changes share what is known of pairs with the running monitor: testing them in advance must not touch it.
TEST(World, APreparedChangeDoesNotAlterTheCycles) {
  ChangingWorld world(4);
  for (int i = 0; i < 8; ++i) world.change();
  WorldEditor editor(coarse());
  const auto snapshot = editor.next(world.description());
  SceneDescription more = world.description();
  more.bodies.push_back(body("late", Primitive(Sphere{0.3}), true));
  const auto next = editor.next(more);
  Monitor alone(snapshot->scene, soft()), prepared(snapshot->scene, soft());
  int contacts = 0, skipped = 0;
  for (int cycle = 0; cycle < 60; ++cycle) {
    const CycleMotion motion = world.motion();
    const CycleResult expected = alone.run(motion, {}), found = prepared.run(motion, {});
    for (std::size_t p = 0; p < expected.pairs.size(); ++p) {
      ASSERT_EQ(found.pairs[p].verdict, expected.pairs[p].verdict) << cycle;
      ASSERT_EQ(found.pairs[p].skipped, expected.pairs[p].skipped) << cycle;
      ASSERT_EQ(found.pairs[p].clearance, expected.pairs[p].clearance) << cycle;
    }
    contacts += expected.verdict == Verdict::kContact;
    skipped += expected.skipped;
    CycleMotion likely = world.rest(true);
    likely.X_WB.push_back({translation({0, 0, 0.1})});
    const auto change = prepared.prepare(next->scene, &likely);
    if (cycle % 20 == 19) prepared.reset(), alone.reset();
  }
  EXPECT_GT(contacts, 5);
  EXPECT_GT(skipped, 50);
}

/// The link, which does not rotate, moves from one place to another; all objects of the world rest.
CycleMotion linkMotion(const SceneDescription& description, const Vector3d& from, const Vector3d& to) {
  CycleMotion motion;
  motion.times = {0.0, 0.1};
  for (const BodyDescription& one : description.bodies)
    motion.X_WB.push_back(one.is_world ? still(one.X_frame_B)
                                       : std::vector<Isometry3d>{translation(from), translation(to)});
  return motion;
}

/// Objects that appear are tested in advance: the next cycle tests those that are near, though a link has moved.
TEST(World, TheFirstCycleTestsWhatIsNear) {
  const BodyOptions options = coarse();
  SceneDescription description{{body("link", Primitive(Sphere{0.1})), body("foot", Primitive(Sphere{0.1}), true)}, {}};
  for (const bool in_advance : {false, true}) {
    description.bodies.resize(2);
    description.bodies[1].X_frame_B = translation({-1.0, 0, 0});
    WorldEditor editor(options);
    Monitor monitor(editor.next(description)->scene, soft());
    monitor.run(linkMotion(description, {0, 0, 0.0}, {0, 0, 0.01}), {});
    const CycleMotion before_adoption = linkMotion(description, {0, 0, 0.01}, {0, 0, 0.05});
    for (int i = 0; i < 100; ++i) {
      description.bodies.push_back(body("o" + std::to_string(i), Primitive(Sphere{0.05}), true));
      description.bodies.back().X_frame_B = translation({0.2 + 0.05 * i, 0, 0});
    }
    const CycleMotion likely = linkMotion(description, {0, 0, 0.0}, {0, 0, 0.01});
    const auto change = monitor.prepare(editor.next(description)->scene, in_advance ? &likely : nullptr);
    monitor.run(before_adoption, {});
    monitor.adopt(*change);
    const CycleResult first = monitor.run(linkMotion(description, {0, 0, 0.05}, {0, 0, 0.06}), {});
    EXPECT_EQ(first.verdict, Verdict::kClear);
    if (in_advance) {
      EXPECT_LT(first.checked, 5);
    } else {
      EXPECT_EQ(first.checked, 100);
    }
    EXPECT_GT(first.pairs.back().clearance, 1.0) << "of the farthest object";
  }
}

/// What was known of a pair that was tested in advance must not hide that the link has been inside the object since.
TEST(World, ALinkInsideWhatAppearsIsSeen) {
  const BodyOptions options = coarse();
  SceneDescription description{{body("link", Primitive(Sphere{0.05})), body("foot", Primitive(Sphere{0.1}), true)}, {}};
  description.bodies[1].X_frame_B = translation({-9.0, 0, 0});
  for (const double last : {0.0, 0.2, 0.44, 0.46, 0.56, 0.69}) {  // the box ends at 0.5 m
    description.bodies.resize(2);
    WorldEditor editor(options);
    Monitor monitor(editor.next(description)->scene, soft());
    monitor.run(linkMotion(description, {0.69, 0, 0}, {0.7, 0, 0}), {});
    const CycleMotion before_adoption = linkMotion(description, {0.7, 0, 0}, {last, 0, 0});
    description.bodies.push_back(body("box", Primitive(Box::fromSize({1.0, 1.0, 1.0})), true));
    const std::shared_ptr<const Scene> scene = editor.next(description)->scene;
    const CycleMotion likely = linkMotion(description, {0.7, 0, 0}, {0.7, 0, 0});
    const auto change = monitor.prepare(scene, &likely);
    monitor.run(before_adoption, {});
    monitor.adopt(*change);
    for (int cycle = 0; cycle < 3; ++cycle) {
      const CycleMotion rest = linkMotion(description, {last, 0, 0}, {last, 0, 0});
      EXPECT_EQ(monitor.run(rest, {}).verdict, Monitor(scene, soft()).run(rest, {}).verdict) << last;
    }
    EXPECT_EQ(monitor.run(linkMotion(description, {last, 0, 0}, {last, 0, 0}), {}).verdict,
              last < 0.55 ? Verdict::kContact : Verdict::kClear)
        << last;
  }
}

TEST(World, KeepsIdsAndBodiesThatDoNotChange) {
  const BodyOptions options = coarse();
  SceneDescription description{
      {body("arm", meshShape(torusMesh(0.12, 0.04, 16, 8))), body("wall", Primitive(Box::fromSize({2, 0.2, 2})), true)},
      {}};
  WorldEditor editor(options);
  const auto first = editor.next(description);
  EXPECT_EQ(first->version, 1U);
  description.bodies.push_back(body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})), true));
  const auto second = editor.next(description);
  EXPECT_EQ(second->prepared, 1);
  EXPECT_EQ(second->scene->bodies.shared(0), first->scene->bodies.shared(0));
  EXPECT_EQ(second->body_ids[1], first->body_ids[1]);

  description.bodies.erase(description.bodies.begin() + 1);
  const auto third = editor.next(description);
  EXPECT_EQ(third->prepared, 0);
  EXPECT_EQ(third->body_ids[1], second->body_ids[2]);
  EXPECT_EQ(third->scene->bodies.shared(1), second->scene->bodies.shared(2));
  // The wall returns, and another box of the same geometry: nothing is built again.
  description.bodies.push_back(body("wall", Primitive(Box::fromSize({2, 0.2, 2})), true));
  description.bodies.push_back(body("box2", Primitive(Box::fromSize({0.2, 0.2, 0.2})), true));
  const auto fourth = editor.next(description);
  EXPECT_EQ(fourth->prepared, 0);
  EXPECT_EQ(fourth->shared, 2);
  EXPECT_NE(fourth->body_ids[2], first->body_ids[1]);
  EXPECT_EQ(first->scene->bodies.size(), 2U);  // unchanged
}

TEST(World, WhatBodiesShareCountsOnce) {
  const auto torus = meshShape(torusMesh(0.12, 0.04, 16, 8));
  SceneDescription description{{body("arm", Primitive(Sphere{0.1})), body("torus", torus, true)}, {}};
  WorldEditor editor(coarse());
  const auto bytesOf = [&](const Scene& scene) {
    std::size_t bytes = 0;
    for (const BodyReport& report : scene.reports) bytes += report.field_bytes + report.shell_bytes;
    return bytes;
  };
  const std::size_t alone = bytesOf(*editor.next(description)->scene);
  EXPECT_GT(alone, 0u);
  description.bodies.push_back(body("twin", torus, true));
  EXPECT_EQ(bytesOf(*editor.next(description)->scene), alone);
  description.bodies.erase(description.bodies.begin() + 1);
  EXPECT_EQ(bytesOf(*editor.next(description)->scene), alone) << "it is the twin's then";
}

TEST(World, AChangeThatFailsChangesNothing) {
  SceneDescription description{
      {body("arm", Primitive(Sphere{0.1})), body("wall", Primitive(Box::fromSize({2, 0.2, 2})), true)}, {}};
  WorldEditor editor(coarse());
  editor.next(description);
  SceneDescription bad = description;
  bad.bodies.push_back(body("flat", Primitive(Box::fromSize({0.2, 0.0, 0.2})), true));
  EXPECT_THROW(editor.next(bad), std::invalid_argument);
  bad.bodies.back() = body("wall", Primitive(Sphere{0.1}), true);
  EXPECT_THROW(editor.next(bad), std::invalid_argument);
  EXPECT_EQ(editor.next(description)->version, 2U);
}

/// While a request's body is built, a map's version can be made; the request then goes on top of it.
TEST(World, AVersionIsMadeWhileBodiesOfAnotherAreBuilt) {
  SceneDescription description{
      {body("arm", Primitive(Sphere{0.1})), body("wall", Primitive(Box::fromSize({2, 0.2, 2})), true)}, {}};
  WorldEditor editor(coarse());
  editor.next(description);
  SceneDescription with_part = description, with_map = description;
  with_part.bodies.push_back(body("part", meshShape(torusMesh(0.12, 0.04, 16, 8)), true));
  with_map.bodies.push_back(body("tile", Primitive(Box::fromSize({0.4, 0.4, 0.4})), true));
  std::shared_ptr<const WorldSnapshot> map;
  const auto parts = editor.prepare(with_part, [&](const std::string&) {
    if (!map) std::thread([&] { map = editor.next(with_map); }).join();
  });
  ASSERT_NE(map, nullptr);
  EXPECT_EQ(map->version, 2u);
  with_part.bodies.push_back(with_map.bodies.back());
  const auto next = editor.next(with_part, *parts);
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->version, 3u);
  EXPECT_GE(next->prepared, 1);
  EXPECT_EQ(next->scene->bodies.shared(3), map->scene->bodies.shared(2));
  EXPECT_EQ(next->scene->pairs.size(), 3u);
}

TEST(World, NothingIsMadeOfBodiesThatAreNotBuilt) {
  SceneDescription description{
      {body("arm", Primitive(Sphere{0.1})), body("wall", Primitive(Box::fromSize({2, 0.2, 2})), true)}, {}};
  WorldEditor editor(coarse());
  const auto parts = editor.prepare(description);
  description.bodies.push_back(body("part", meshShape(torusMesh(0.12, 0.04, 16, 8)), true));
  EXPECT_EQ(editor.next(description, *parts), nullptr);
  EXPECT_EQ(editor.next(description)->version, 1u);
}

TEST(World, WarnsOfBodiesThatAreMade) {
  const TriangleMesh torus = torusMesh(0.12, 0.04, 16, 8);
  SceneDescription description{
      {body("arm", meshShape(torus)), body("wall", Primitive(Box::fromSize({2, 0.2, 2})), true)}, {}};
  BodyOptions options = coarse();
  options.shell.spacing = 10.0;
  WorldEditor editor(options);
  EXPECT_TRUE(editor.next(description)->warnings.empty());
  description.bodies.push_back(body("part", meshShape(scaled(torus, Vector3d::Constant(1e3))), true));
  const auto in_millimetres = editor.next(description);
  ASSERT_EQ(in_millimetres->warnings.size(), 1u);
  EXPECT_EQ(in_millimetres->warnings[0].find("part: "), 0u) << in_millimetres->warnings[0];
  EXPECT_NE(in_millimetres->warnings[0].find("320 m long: is it in millimetres?"), std::string::npos)
      << in_millimetres->warnings[0];
  description.bodies.back().X_frame_B = translation({1.0, 0, 0});
  EXPECT_TRUE(editor.next(description)->warnings.empty()) << "it was warned of before";
}

TEST(World, LeavesOutWhatTheFirstSceneLeftOut) {
  SceneDescription description{
      {body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1})), body("c", Primitive(Sphere{0.1}))}, {}};
  const BodyOptions options = coarse();
  const ScenePlan plan = planOf(description, options);
  Scene scene = buildScene(description, plan, options);
  leaveOut({{"a", "c", "overlap", PairKind::kAtRest, 0.02, {}, 0, 2}}, scene);
  WorldEditor editor(options);
  const auto first = editor.begin(description, plan, scene);
  const auto second = editor.next(*first->description);
  ASSERT_EQ(second->scene->pairs.size(), 2U);
  EXPECT_EQ(second->description->allowed.back().text, "overlap");
  EXPECT_EQ(second->scene->left_out.back().depth, 0.02);
  EXPECT_EQ(second->prepared, 0);
}

/// A map whose voxels are all the robot's leaves no tile, and an SRDF may leave a link no pair. The next map's voxels
/// there are still the link's.
TEST(World, LinksAreKnownToALiveMapBesideNothingElse) {
  const Shape torus = meshShape(torusMesh(0.3, 0.1, 24, 12));
  SceneDescription description{{body("arm", torus), body("hand", torus)}, {{"arm", "hand", "SRDF: Adjacent"}}};
  const auto without = WorldEditor(coarse()).next(description)->scene;
  description.has_live_map = true;
  WorldEditor editor(coarse());
  for (int map = 0; map < 2; ++map) {
    const auto scene = editor.next(description)->scene;
    for (const std::size_t b : {0u, 1u}) {
      EXPECT_EQ(without->bodies[b].parts.size(), 0U);
      EXPECT_EQ(scene->bodies[b].parts.size(), 1U);
      EXPECT_TRUE(scene->bodies[b].surface);
      EXPECT_TRUE(maskOf(scene->bodies[b], description.bodies[b], Isometry3d::Identity()));
    }
  }
}

TEST(World, AMonitorRefusesAChangeOfAnotherScene) {
  WorldEditor editor(coarse());
  SceneDescription description{
      {body("arm", Primitive(Sphere{0.1})), body("wall", Primitive(Box::fromSize({2, 0.2, 2})), true)}, {}};
  const auto first = editor.next(description);
  description.bodies.push_back(body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})), true));
  const auto second = editor.next(description);
  Monitor monitor(first->scene, {});
  const auto change = monitor.prepare(second->scene), late = monitor.prepare(second->scene);
  monitor.adopt(*change);
  EXPECT_THROW(monitor.adopt(*late), std::logic_error);
  EXPECT_EQ(&monitor.scene(), second->scene.get());
}

}  // namespace sdf_ccd::world_test
