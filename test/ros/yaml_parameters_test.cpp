#include "ros/parameters/yaml_parameters.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "ros/parameters/parameters.h"

namespace sdf_ccd::yaml_parameters_test {

XmlRpc::XmlRpcValue load(const std::string& text) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a_test.yaml";
  test::writeText(file, text);
  return loadYamlParameters(file.string());
}

std::string errorOf(const std::string& text) {
  return test::failureOf<std::exception>([&] { parseParameters(load(text), "~"); });
}

TEST(YamlParameters, ScalarsAreWhatRosparamTakesThemFor) {
  using XmlRpc::XmlRpcValue;
  XmlRpcValue tree = load(
      "flags: [yes, False, ON]\nintegers: [30, -5, 010, 0x10, 0]\nreals: [1., .5, 1.0e+8, -2.5E-3]\n"
      "texts: [1.0e8, 1e5, '30', \"yes\", y, 089, fixed, 3000000000, deg(90)]\ngroup/inner: 1\nempty: {}\nlist: []\n");
  for (int i = 0; i < tree["flags"].size(); ++i) EXPECT_EQ(bool(tree["flags"][i]), i != 1);
  const int integers[] = {30, -5, 8, 16, 0};
  for (int i = 0; i < tree["integers"].size(); ++i) EXPECT_EQ(int(tree["integers"][i]), integers[i]);
  const double reals[] = {1.0, 0.5, 1e8, -2.5e-3};
  for (int i = 0; i < tree["reals"].size(); ++i) EXPECT_EQ(double(tree["reals"][i]), reals[i]);
  for (int i = 0; i < tree["texts"].size(); ++i) EXPECT_EQ(tree["texts"][i].getType(), XmlRpcValue::TypeString) << i;
  EXPECT_EQ(int(tree["group"]["inner"]), 1);
  EXPECT_EQ(tree["empty"].getType(), XmlRpcValue::TypeStruct);
  EXPECT_EQ(tree["list"].getType(), XmlRpcValue::TypeArray);
}

TEST(YamlParameters, WhatExpandsWithoutEndIsRefused) {
  // Ten aliases of ten aliases each, ten levels deep; a list that contains itself; deeply nested brackets and blocks.
  std::string laughs = "a0: &a0 [x,x,x,x,x,x,x,x,x,x]\n", blocks;
  for (int i = 1; i < 10; ++i) {
    const std::string name = "a" + std::to_string(i), before = "*a" + std::to_string(i - 1);
    laughs += name + ": &" + name + " [" + before;
    for (int k = 1; k < 10; ++k) laughs += "," + before;
    laughs += "]\n";
  }
  for (int i = 0; i < 100; ++i) blocks += std::string(i, ' ') + "a:\n";
  std::string signs = "a:\n  ";
  for (int i = 0; i < 10000; ++i) signs += "- ";
  EXPECT_NE(errorOf(laughs).find("more than 100000 values"), std::string::npos) << errorOf(laughs);
  EXPECT_NE(errorOf("world: &a [*a]\n").find("levels deep"), std::string::npos);
  EXPECT_NE(errorOf("a: " + std::string(100'000, '[')).find("levels deep"), std::string::npos);
  EXPECT_NE(errorOf(blocks).find("levels deep"), std::string::npos) << errorOf(blocks);
  EXPECT_NE(errorOf(signs + "1\n").find("levels deep"), std::string::npos);
  std::string closed_in_strings, closed_in_comments, slashes;
  for (int i = 0; i < 1000; ++i) {
    closed_in_strings += "[\"]\",\n ";
    closed_in_comments += "[ # ]\n ";
    slashes += "a/";
  }
  for (const std::string& text : {"a: " + closed_in_strings, "a: " + closed_in_comments, "? " + slashes + "a\n: 1\n"})
    EXPECT_NE(errorOf(text).find("nested more than 64 levels deep"), std::string::npos) << errorOf(text);
  std::string shallow = "rate: 30  # [[[\nurdf_parameter: \"";
  EXPECT_EQ(errorOf(shallow + std::string(100, '[') + "\"\n"), "");
}

/// Regular expressions recurse for each byte.
TEST(YamlParameters, NumbersOfAMillionDigitsAreRefused) {
  const std::string digits(1'000'000, '1');
  for (const std::string& number : {digits, "0." + digits, "0x" + digits}) {
    EXPECT_EQ(load("rate: " + number)["rate"].getType(), XmlRpc::XmlRpcValue::TypeString);
    EXPECT_LT(errorOf("max_points: " + number).size(), 600u);
  }
}

TEST(YamlParameters, AValueIsNoGroup) {
  EXPECT_NE(
      errorOf("rate: 30\nrate/x: 1\n").find("parameter rate/x is inside a parameter that is a value, not a group"),
      std::string::npos)
      << errorOf("rate: 30\nrate/x: 1\n");
  EXPECT_NE(errorOf("rate/x: 1\nrate: 30\n").find("parameter rate is set twice"), std::string::npos);
  EXPECT_NE(errorOf("rate: 30\nrate: 20\n").find("parameter rate is set twice"), std::string::npos);
}

TEST(YamlParameters, DevicesAreRefused) {
  EXPECT_THROW(loadYamlParameters("/dev/zero"), std::runtime_error);
  EXPECT_THROW(loadYamlParameters("/none"), std::runtime_error);
}

TEST(YamlParameters, TheDocumentedParametersAreTheDefaults) {
  const MonitorParameters documented =
      parseParameters(loadYamlParameters(SDF_CCD_SOURCE_DIR "/config/monitor.yaml"), "~");
  const MonitorParameters defaults = parseParameters(load(""), "~");
  EXPECT_TRUE(documented.unknown.empty()) << documented.unknown.front();
  EXPECT_EQ(documented.urdf_parameter, defaults.urdf_parameter);
  EXPECT_EQ(documented.srdf_parameter, defaults.srdf_parameter);
  EXPECT_EQ(documented.scene.field.cell_size, defaults.scene.field.cell_size);
  EXPECT_EQ(documented.scene.field.max_bytes, defaults.scene.field.max_bytes);
  EXPECT_EQ(documented.scene.shell.spacing, defaults.scene.shell.spacing);
  EXPECT_EQ(documented.scene.shell.edge_gap, defaults.scene.shell.edge_gap);
  EXPECT_EQ(documented.scene.shell.vertex_spacing, defaults.scene.shell.vertex_spacing);
  EXPECT_EQ(documented.scene.cache_directory, defaults.scene.cache_directory);
  EXPECT_EQ(documented.monitor.contact.stiffness, defaults.monitor.contact.stiffness);
  EXPECT_EQ(documented.monitor.chords.tolerance, defaults.monitor.chords.tolerance);
  EXPECT_EQ(documented.tf.max_latency, defaults.tf.max_latency);
  EXPECT_EQ(documented.tf.max_cycle, defaults.tf.max_cycle);
  EXPECT_EQ(documented.rate, defaults.rate);
  EXPECT_EQ(documented.max_points, defaults.max_points);
  EXPECT_EQ(documented.scene.max_preparation_time, defaults.scene.max_preparation_time);
  EXPECT_EQ(documented.scene.field.band, defaults.scene.field.band);
  EXPECT_EQ(documented.scene.shell.seed, defaults.scene.shell.seed);
  EXPECT_EQ(documented.monitor.contact.damping, defaults.monitor.contact.damping);
  EXPECT_EQ(documented.monitor.contact.stiffness_per, defaults.monitor.contact.stiffness_per);
  EXPECT_EQ(documented.monitor.contact.normal, defaults.monitor.contact.normal);
  EXPECT_EQ(documented.monitor.contact.quadrature, defaults.monitor.contact.quadrature);
  EXPECT_EQ(documented.monitor.contact.midpoint_intervals, defaults.monitor.contact.midpoint_intervals);
  EXPECT_EQ(documented.contact_join.time, defaults.contact_join.time);
  EXPECT_EQ(documented.contact_join.distance, defaults.contact_join.distance);
  EXPECT_EQ(documented.monitor.chords.max_chords, defaults.monitor.chords.max_chords);
  EXPECT_EQ(documented.max_cycle_time, defaults.max_cycle_time);
  EXPECT_EQ(documented.request_time, defaults.request_time);
  EXPECT_EQ(documented.trigger.kind, defaults.trigger.kind);
  EXPECT_EQ(documented.refine, defaults.refine);
  EXPECT_EQ(documented.overlapping_pairs, defaults.overlapping_pairs);
  EXPECT_EQ(documented.robot.check_adjacent, defaults.robot.check_adjacent);
  EXPECT_EQ(documented.allow_http, defaults.allow_http);
  EXPECT_EQ(documented.log_contacts, defaults.log_contacts);
  EXPECT_EQ(documented.live_map.unknown, defaults.live_map.unknown);
  EXPECT_EQ(documented.live_map.unknown_distance, defaults.live_map.unknown_distance);
  EXPECT_EQ(documented.live_map.padding, defaults.live_map.padding);
  EXPECT_EQ(documented.live_map.max_age, defaults.live_map.max_age);
  EXPECT_EQ(documented.octomap.cell_size, defaults.octomap.cell_size);
  EXPECT_EQ(documented.proximity.thresholds.hysteresis, defaults.proximity.thresholds.hysteresis);
  EXPECT_FALSE(documented.proximity.thresholds.any());
  EXPECT_FALSE(documented.proximity.promise);
  EXPECT_EQ(documented.markers.scale, defaults.markers.scale);
  EXPECT_EQ(documented.markers.hold, defaults.markers.hold);
  const RequestPermissions allowed = documented.requests, preset = defaults.requests;
  for (const auto kind :
       {&RequestPermissions::add, &RequestPermissions::move, &RequestPermissions::attach, &RequestPermissions::rules,
        &RequestPermissions::clear, &RequestPermissions::reset, &RequestPermissions::limits})
    EXPECT_EQ(allowed.*kind, preset.*kind);
}

/// As config/monitor.yaml states them, each on both sides.
TEST(YamlParameters, NumbersAreRejectedBeyondTheirLimitsAndAcceptedAtThem) {
  struct Limits {
    const char* key;
    std::vector<const char*> accepted, rejected;
  };
  const std::vector<Limits> all{
      {"max_error", {"0.00001", "0.01"}, {"0.0000099", "0.0101", "0", "-0.001"}},
      {"request_time", {"0.001", "3600"}, {"0", "3601", "-1"}},
      {"max_preparation_time", {"0.001", "1.0e+6"}, {"0", "-1"}},
      {"octomap/unknown_distance", {"0", "5"}, {"-0.001"}},
      {"octomap/padding", {"0", "1"}, {"-0.001"}},
      {"octomap/max_age", {"0", "10"}, {"-1"}},
      {"octomap/cell_size", {"0", "0.01"}, {"-0.01"}},
      {"field/cells", {"2", "100"}, {"1", "0", "2.5"}},
      {"field/cell_size", {"0.001"}, {"0", "-0.001"}},
      {"field/max_error", {"0.001"}, {"0", "-0.001"}},
      {"field/band", {"0", "0.1"}, {"-0.001"}},
      {"field/max_megabytes", {"0.5", "1.0e+6"}, {"0", "-1"}},
      {"shell/spacing", {"0.001"}, {"0", "-0.001"}},
      {"shell/edge_gap", {"0", "0.001"}, {"-0.001"}},
      {"shell/vertex_spacing", {"0", "0.001"}, {"-0.001"}},
      {"shell/seed", {"0", "7"}, {"-1", "1.5"}},
      {"contact/accuracy", {"0.001"}, {"0", "-0.001"}},
      {"contact/stiffness", {"0", "1.0e+9"}, {"-1"}},
      {"contact/damping", {"0", "10"}, {"-1"}},
      {"contact/join_time", {"0", "3600"}, {"-0.1", "3601"}},
      {"contact/join_distance", {"0", "1"}, {"-0.1"}},
      {"contact/midpoint_intervals", {"1", "20"}, {"0", "-1"}},
      {"rate", {"0.001", "10000"}, {"0", "-30"}},
      {"chord_tolerance", {"0.00001"}, {"0", "-1"}},
      {"max_chords", {"1"}, {"0", "-1"}},
      {"max_latency", {"0.001", "3600"}, {"0", "-1", "3601"}},
      {"max_cycle", {"0.001", "3600"}, {"0", "-1", "3601"}},
      {"max_cycle_time", {"-1", "0", "10"}, {"-0.5", "-2"}},
      {"report_distance", {"0", "1"}, {"-0.1"}},
      {"warning_distance", {"0", "1"}, {"-0.1"}},
      {"stop_distance", {"0", "1"}, {"-0.1"}},
      {"hysteresis", {"0", "1"}, {"-0.1"}},
      {"velocity_scale/max_speed", {"0.01"}, {"0", "-1"}},
      {"velocity_scale/max_acceleration", {"5.0"}, {"-1"}},
      {"velocity_scale/deceleration", {"2.0"}, {"0", "-1"}},
      {"velocity_scale/reaction_time", {"0.1"}, {"-1"}},
      {"velocity_scale/period", {"0.1"}, {"0", "-1"}},
      {"velocity_scale/max_age", {"0.2"}, {"0", "-1"}},
      {"max_points", {"0", "100"}, {"-1", "2.5"}},
      {"marker_scale", {"0.01"}, {"0", "-1"}},
      {"marker_hold", {"0", "5"}, {"-0.1"}},
  };
  for (const auto& [key, accepted, rejected] : all) {
    const std::string name = std::string(key) + ": ";
    for (const char* value : accepted) EXPECT_EQ(errorOf(name + value), "") << key << " " << value;
    for (const char* value : rejected)
      EXPECT_EQ(errorOf(name + value).find("parameter ~/" + std::string(key)), 0u) << key << " " << value;
    for (const char* value : {".nan", ".inf", "many", "[1]", "true"})
      EXPECT_EQ(errorOf(name + value).find("parameter ~/" + std::string(key)), 0u) << key << " " << value;
  }
  EXPECT_EQ(errorOf("warning_distance: 0.01\nstop_distance: 0.02").find("parameter ~/warning_distance"), 0u);
  EXPECT_EQ(errorOf("warning_distance: 0.02\nstop_distance: 0.02"), "");
  EXPECT_EQ(errorOf("urdf_file: robot.urdf").find("parameter ~/urdf_file"), 0u);
  EXPECT_EQ(errorOf("resource_roots: [worlds]").find("parameter ~/resource_roots"), 0u);
  EXPECT_EQ(errorOf("trigger: frames").find("parameter ~/trigger_frames"), 0u);
}

TEST(YamlParameters, WhatIsShorterThanStatedIsTheStatedMinimum) {
  const auto parse = [](const std::string& text) { return parseParameters(load(text), "~"); };
  EXPECT_EQ(parse("contact: {join_time: 0}").contact_join.time, std::chrono::milliseconds(1));
  EXPECT_EQ(parse("").trigger.patience, 0.1);
  EXPECT_EQ(parse("max_latency: 0.05").trigger.patience, 0.05);
  EXPECT_EQ(parse("urdf_parameter: arm").srdf_parameter, "arm_semantic");
}

TEST(YamlParameters, ACyclesTimeFollowsTheRateUnlessItIsSet) {
  const auto limit = [](const std::string& text) { return cycleTimeLimit(parseParameters(load(text), "~")); };
  EXPECT_DOUBLE_EQ(limit("rate: 100"), 0.008);
  EXPECT_DOUBLE_EQ(limit("rate: 100\nmax_cycle_time: -1"), 0.008);
  EXPECT_EQ(limit("max_cycle_time: 0"), 0.0);
  EXPECT_EQ(limit("max_cycle_time: 0.02"), 0.02);
  for (const char* bad : {"-0.5", "-2", ".nan", ".inf"})
    EXPECT_NE(errorOf(std::string("max_cycle_time: ") + bad).find("max_cycle_time"), std::string::npos) << bad;
}

TEST(YamlParameters, PairsByRule) {
  const MonitorParameters parameters = parseParameters(
      load("allowed_pairs: [[hand, table], [\"finger_*\", part]]\nchecked_pairs: [[a, b]]\noverlapping_pairs: check"),
      "~");
  ASSERT_EQ(parameters.pairs.allowed.size(), 2u);
  EXPECT_EQ(parameters.pairs.allowed[1].a, "finger_*");
  EXPECT_EQ(parameters.pairs.allowed[1].b, "part");
  ASSERT_EQ(parameters.pairs.checked.size(), 1u);
  EXPECT_EQ(parameters.overlapping_pairs, OverlapRule::Kind::kCheck);
  EXPECT_EQ(parseParameters({}, "~").overlapping_pairs, OverlapRule::Kind::kNeighbours);
  EXPECT_EQ(parseParameters(load("overlapping_pairs: rest"), "~").overlapping_pairs, OverlapRule::Kind::kRest);
  EXPECT_EQ(parseParameters(load("overlapping_pairs: leave_out"), "~").overlapping_pairs, OverlapRule::Kind::kLeaveOut);
  for (const char* wrong : {"allowed_pairs: hand", "allowed_pairs: [hand, table]", "allowed_pairs: [[hand]]",
                            "allowed_pairs: [[hand, '']]", "allowed_pairs: [[hand, 5]]", "allowed_pairs: [[a, b, c]]"})
    EXPECT_NE(errorOf(wrong).find("expected a list of pairs of strings"), std::string::npos) << wrong;
  std::string many = "checked_pairs:\n";
  for (int i = 0; i <= 1000; ++i) many += "- [a, b]\n";
  EXPECT_NE(errorOf(many).find("expected at most 1000 pairs"), std::string::npos);
  EXPECT_NE(errorOf("overlapping_pairs: ignore").find("expected one of neighbours rest leave_out check"),
            std::string::npos);
}

TEST(YamlParameters, WhatIsMeasuredOnTrianglesIsPreparedForIt) {
  const MonitorParameters defaults = parseParameters(load(""), "~");
  EXPECT_EQ(defaults.refine, Refinement::kNone);
  EXPECT_FALSE(defaults.scene.exact_depths);
  const MonitorParameters refined = parseParameters(load("refine: deepest"), "~");
  EXPECT_EQ(refined.refine, Refinement::kDeepest);
  EXPECT_TRUE(refined.scene.exact_depths);
  EXPECT_NE(errorOf("refine: all").find("expected one of none deepest"), std::string::npos);
}

TEST(YamlParameters, MaxErrorIsOfVerdictsAndLeavesFieldsAndShells) {
  const auto parse = [](const std::string& text) { return parseParameters(load(text), "~"); };
  const MonitorParameters none = parse(""), fine = parse("max_error: 0.00001"), coarse = parse("max_error: 0.01");
  EXPECT_EQ(none.monitor.max_error, 1e-4);
  EXPECT_FALSE(none.scene.max_error);  // no warning that a map has a larger error
  EXPECT_EQ(fine.monitor.max_error, 1e-5);
  EXPECT_EQ(fine.scene.max_error, 1e-5);
  for (const MonitorParameters* p : {&none, &fine, &coarse}) {
    EXPECT_EQ(p->scene.shell.spacing, none.scene.shell.spacing);
    EXPECT_EQ(p->scene.field.cell_size, none.scene.field.cell_size);
    EXPECT_EQ(p->monitor.chords.tolerance, 1e-4);  // for contacts
    EXPECT_LE(2.0 * p->tf.sampling.tolerance, 0.4001 * p->monitor.max_error);
    EXPECT_LE(p->tf.sampling.tolerance, 1e-4);
    EXPECT_EQ(p->scene.motion_error, 2.0 * p->tf.sampling.tolerance);
    EXPECT_EQ(p->scene.motion_margin, p->scene.motion_error + p->monitor.chords.tolerance);
  }
  const MonitorParameters given = parse("chord_tolerance: 0.00005");
  EXPECT_EQ(given.tf.sampling.tolerance, 0.00005);
  EXPECT_EQ(given.monitor.chords.tolerance, 0.00005);
  for (const char* wrong : {"max_error: 0.000001", "max_error: 0.02"})
    EXPECT_NE(errorOf(wrong).find("expected from 1e-05 to 0.01 m"), std::string::npos) << errorOf(wrong);
  EXPECT_NE(errorOf("max_error: -0.001").find("~/max_error is -0.001"), std::string::npos);
}

TEST(YamlParameters, ContactAccuracySetsFieldsAndShells) {
  const auto parse = [](const std::string& text) { return parseParameters(load(text), "~").scene; };
  EXPECT_GT(parse("").points_across, 0.0);
  EXPECT_GT(parse("").cells_across, 0.0);
  const BodyOptions accurate = parse("contact: {accuracy: 0.002}");
  EXPECT_EQ(accurate.points_across, 0.0);
  EXPECT_EQ(accurate.cells_across, 0.0);
  EXPECT_EQ(accurate.shell.spacing, 0.002);
  EXPECT_EQ(accurate.shell.vertex_spacing, 0.0008);
  EXPECT_EQ(accurate.field.cell_size, 1.2 * 0.002);
  const BodyOptions cells = parse("contact: {accuracy: 0.002}\nfield: {max_error: 0.001}\nshell: {edge_gap: 0.0005}");
  EXPECT_EQ(cells.field.max_error, 0.001);
  EXPECT_FALSE(cells.field.cell_size);
  EXPECT_EQ(cells.shell.spacing, 0.002);
  EXPECT_EQ(cells.shell.edge_gap, 0.0005);
  const BodyOptions points = parse("shell: {spacing: 0.005}");
  EXPECT_EQ(points.points_across, 0.0);
  EXPECT_EQ(points.shell.vertex_spacing, 0.002);
  EXPECT_GT(points.cells_across, 0.0);
  EXPECT_NE(errorOf("contact: {accuracy: 0}").find("~/contact/accuracy is 0"), std::string::npos);
  EXPECT_NE(errorOf("field: {cell_size: 0.0002, max_error: 0.0002}").find("only one of cells"), std::string::npos);
}

TEST(YamlParameters, LimitsOfTheVelocityScaleNeedItsMaxSpeed) {
  const auto promise = [](const std::string& limits) {
    return parseParameters(load("velocity_scale: {" + limits + "}"), "~").proximity.promise;
  };
  EXPECT_FALSE(promise("deceleration: 2.0"));  // the default
  EXPECT_EQ(promise("max_speed: 1.0, deceleration: 3.0").value().deceleration, 3.0);
  EXPECT_EQ(errorOf("velocity_scale: {deceleration: 3.0}"),
            "parameter ~/velocity_scale/max_speed is missing, expected a positive number, as other limits of the "
            "velocity scale are set");
}

TEST(YamlParameters, OwnPairsLimitAsMeasuredUnlessTheyPromise) {
  const auto rule = [](const std::string& own_pairs) {
    return parseParameters(load("velocity_scale: {max_speed: 1.0" + own_pairs + "}"), "~").proximity.promise->own_pairs;
  };
  EXPECT_EQ(rule(""), OwnPairs::kMeasured);
  EXPECT_EQ(rule(", own_pairs: promise"), OwnPairs::kPromise);
  EXPECT_NE(errorOf("velocity_scale: {max_speed: 1.0, own_pairs: never}").find("~/velocity_scale/own_pairs"),
            std::string::npos);
  EXPECT_NE(errorOf("velocity_scale: {own_pairs: promise}").find("~/velocity_scale/max_speed is missing"),
            std::string::npos);
}

TEST(YamlParameters, PairsHaveTheirOwnStopDistance) {
  const std::vector<PairLimit> limits =
      parseParameters(load("pairs: [{bodies: ['finger_*', part], stop_distance: 0.0}, {bodies: [a, b]}]"), "~")
          .proximity.pairs;
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(limits[0].bodies.a, "finger_*");
  EXPECT_EQ(limits[0].bodies.b, "part");
  EXPECT_EQ(limits[0].stop_distance, 0.0);
  EXPECT_FALSE(limits[1].stop_distance);
  EXPECT_NE(errorOf("pairs: [{bodies: [a], stop_distance: 0.1}]").find("~/pairs[0]/bodies"), std::string::npos);
  EXPECT_NE(errorOf("pairs: [{stop_distance: 0.1}]").find("~/pairs[0]/bodies"), std::string::npos);
  EXPECT_NE(errorOf("pairs: [{bodies: [a, b], stop_distance: -0.1}]").find("~/pairs[0]/stop_distance"),
            std::string::npos);
  EXPECT_NE(errorOf("pairs: [{bodies: [a, b], stop: 0.1}]").find("~/pairs[0]/stop"), std::string::npos);
}

TEST(YamlParameters, AMisspeltParameterOfAGroupIsRefused) {
  EXPECT_EQ(errorOf("world: [{name: ball, type: sphere, radius: 0.1, xzy: [1, 2, 3]}]"),
            "unknown parameter ~/world[0]/xzy, did you mean xyz?");
  EXPECT_EQ(errorOf("world: [{name: ball, type: sphere, raduis: 0.1}]"),
            "parameter ~/world[0]/radius is missing, expected a positive number; is it raduis?");
  EXPECT_NE(errorOf("world: [{name: ball, type: sphere, radius: 0.1, size: [1, 1, 1]}]").find("~/world[0]/size"),
            std::string::npos);
  EXPECT_EQ(errorOf("octomap: {fil: map.bt}"), "unknown parameter ~/octomap/fil, did you mean file?");
  EXPECT_EQ(errorOf("field: {cel_size: 0.001}"), "unknown parameter ~/field/cel_size, did you mean cell_size?");
  EXPECT_EQ(errorOf("shell: {spacin: 0.001}"), "unknown parameter ~/shell/spacin, did you mean spacing?");
  EXPECT_EQ(errorOf("contact: {dampin: 1.0}"), "unknown parameter ~/contact/dampin, did you mean damping?");
  // On a parameter server the node's namespace may hold parameters of others.
  const MonitorParameters parameters = parseParameters(load("filed: {cell_size: 0.001}"), "~");
  EXPECT_EQ(parameters.unknown, std::vector<std::string>{"~/filed, did you mean field?"});
}

TEST(YamlParameters, ErrorsNameFileLineAndParameter) {
  EXPECT_NE(errorOf("rate: 30\nshell:\n").find("_test.yaml: line 2: parameter shell has no value"), std::string::npos);
  EXPECT_NE(errorOf("- 1\n").find("_test.yaml: line 1: expected parameters"), std::string::npos);
  EXPECT_NE(errorOf("rate: [30\n").find("_test.yaml: yaml-cpp: error at line"), std::string::npos);
  EXPECT_EQ(errorOf("octomap: {xyz: [deg(90), 0, 0]}"),
            "parameter ~/octomap/xyz is [deg(90), 0, 0], expected three finite numbers");
  EXPECT_THROW(loadYamlParameters("/nowhere/monitor.yaml"), std::runtime_error);
}

}  // namespace sdf_ccd::yaml_parameters_test
