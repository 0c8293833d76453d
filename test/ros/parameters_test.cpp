#include "ros/parameters/parameters.h"

#include <gtest/gtest.h>

#include "common/settings/yaml_settings.h"
#include "oracle/failure.h"
#include "ros/parameters/server_parameters.h"

namespace sdf_ccd::parameters_test {

MonitorParameters parse(const std::string& text) {
  return parseParameters(parseYaml(text), "~");
}

std::string errorOf(const std::string& text) {
  return test::failureOf<std::exception>([&] { parse(text); });
}

bool isAbout(const std::string& error, const std::string& key) {
  return error.find("line 1: parameter ~/" + key) == 0;
}

TEST(Parameters, ThoseOfAServerAreThoseOfAFile) {
  XmlRpc::XmlRpcValue tree;
  tree["rate"] = 50;
  tree["log_contacts"] = false;
  tree["urdf_parameter"] = std::string("arm");
  tree["contact"]["damping"] = 2.5;
  tree["allowed_pairs"][0][0] = std::string("hand");
  tree["allowed_pairs"][0][1] = std::string("table");
  const MonitorParameters parameters = parseParameters(toSetting(tree), "~");
  EXPECT_EQ(parameters.rate, 50.0);
  EXPECT_FALSE(parameters.log_contacts);
  EXPECT_EQ(parameters.urdf_parameter, "arm");
  EXPECT_EQ(parameters.monitor.contact.damping, 2.5);
  ASSERT_EQ(parameters.pairs.allowed.size(), 1u);
  EXPECT_EQ(parameters.pairs.allowed[0].b, "table");
  tree["contact"]["damping"] = std::string("much");
  EXPECT_EQ(test::failureOf<std::exception>([&] { parseParameters(toSetting(tree), "/monitor"); }),
            "parameter /monitor/contact/damping is much, expected a non-negative number");
  EXPECT_EQ(parseParameters(toSetting(XmlRpc::XmlRpcValue()), "~").rate, parse("").rate);
}

TEST(Parameters, TheDocumentedParametersAreTheDefaults) {
  const MonitorParameters documented = parseParameters(loadYaml(SDF_CCD_SOURCE_DIR "/config/monitor.yaml"), "~");
  const MonitorParameters defaults = parse("");
  EXPECT_TRUE(documented.unused.empty()) << documented.unused.front();
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
  EXPECT_EQ(documented.overlapping_pairs, defaults.overlapping_pairs);
  EXPECT_EQ(documented.robot.check_adjacent, defaults.robot.check_adjacent);
  EXPECT_EQ(documented.log_contacts, defaults.log_contacts);
  EXPECT_EQ(documented.live_map.unknown, defaults.live_map.unknown);
  EXPECT_EQ(documented.live_map.unknown_distance, defaults.live_map.unknown_distance);
  EXPECT_EQ(documented.live_map.padding, defaults.live_map.padding);
  EXPECT_EQ(documented.live_map.max_age, defaults.live_map.max_age);
  EXPECT_FALSE(documented.octomap);
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
TEST(Parameters, NumbersAreRejectedBeyondTheirLimitsAndAcceptedAtThem) {
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
      {"contact/midpoint_intervals", {"1", "10000"}, {"0", "-1", "10001"}},
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
    for (const char* value : rejected) EXPECT_TRUE(isAbout(errorOf(name + value), key)) << key << " " << value;
    for (const char* value : {".nan", ".inf", "many", "[1]", "true"})
      EXPECT_TRUE(isAbout(errorOf(name + value), key)) << key << " " << value;
  }
  EXPECT_TRUE(isAbout(errorOf("warning_distance: 0.01\nstop_distance: 0.02"), "warning_distance"));
  EXPECT_EQ(errorOf("warning_distance: 0.02\nstop_distance: 0.02"), "");
  EXPECT_TRUE(isAbout(errorOf("urdf_file: robot.urdf"), "urdf_file"));
  EXPECT_TRUE(isAbout(errorOf("resource_roots: [worlds]"), "resource_roots"));
  EXPECT_TRUE(isAbout(errorOf("trigger: frames"), "trigger_frames"));
}

TEST(Parameters, WhatIsShorterThanStatedIsTheStatedMinimum) {
  EXPECT_EQ(parse("contact: {join_time: 0}").contact_join.time, std::chrono::milliseconds(1));
  EXPECT_EQ(parse("").trigger.patience, 0.1);
  EXPECT_EQ(parse("max_latency: 0.05").trigger.patience, 0.05);
  EXPECT_EQ(parse("urdf_parameter: arm").srdf_parameter, "arm_semantic");
}

TEST(Parameters, ACyclesTimeFollowsTheRateUnlessItIsSet) {
  const auto limit = [](const std::string& text) { return cycleTimeLimit(parse(text)); };
  EXPECT_DOUBLE_EQ(limit("rate: 100"), 0.008);
  EXPECT_DOUBLE_EQ(limit("rate: 100\nmax_cycle_time: -1"), 0.008);
  EXPECT_EQ(limit("max_cycle_time: 0"), 0.0);
  EXPECT_EQ(limit("max_cycle_time: 0.02"), 0.02);
  for (const char* bad : {"-0.5", "-2", ".nan", ".inf"})
    EXPECT_NE(errorOf(std::string("max_cycle_time: ") + bad).find("max_cycle_time"), std::string::npos) << bad;
}

TEST(Parameters, PairsByRule) {
  const MonitorParameters parameters =
      parse("allowed_pairs: [[hand, table], [\"finger_*\", part]]\nchecked_pairs: [[a, b]]\noverlapping_pairs: check");
  ASSERT_EQ(parameters.pairs.allowed.size(), 2u);
  EXPECT_EQ(parameters.pairs.allowed[1].a, "finger_*");
  EXPECT_EQ(parameters.pairs.allowed[1].b, "part");
  ASSERT_EQ(parameters.pairs.checked.size(), 1u);
  EXPECT_EQ(parameters.overlapping_pairs, OverlapRule::Kind::kCheck);
  EXPECT_EQ(parse("").overlapping_pairs, OverlapRule::Kind::kNeighbours);
  EXPECT_EQ(parse("overlapping_pairs: rest").overlapping_pairs, OverlapRule::Kind::kRest);
  EXPECT_EQ(parse("overlapping_pairs: leave_out").overlapping_pairs, OverlapRule::Kind::kLeaveOut);
  for (const char* wrong : {"allowed_pairs: hand", "allowed_pairs: [hand, table]", "allowed_pairs: [[hand]]",
                            "allowed_pairs: [[hand, '']]", "allowed_pairs: [[hand, 5]]", "allowed_pairs: [[a, b, c]]"})
    EXPECT_NE(errorOf(wrong).find("expected a list of pairs of strings"), std::string::npos) << wrong;
  std::string many = "checked_pairs:\n";
  for (int i = 0; i <= 1000; ++i) many += "- [a, b]\n";
  EXPECT_NE(errorOf(many).find("expected at most 1000 pairs"), std::string::npos);
  EXPECT_NE(errorOf("overlapping_pairs: ignore").find("expected one of neighbours rest leave_out check"),
            std::string::npos);
}

TEST(Parameters, MaxErrorIsOfVerdictsAndLeavesFieldsAndShells) {
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

TEST(Parameters, ContactAccuracySetsFieldsAndShells) {
  const auto sceneOf = [](const std::string& text) { return parse(text).scene; };
  EXPECT_GT(sceneOf("").points_across, 0.0);
  EXPECT_GT(sceneOf("").cells_across, 0.0);
  const BodyOptions accurate = sceneOf("contact: {accuracy: 0.002}");
  EXPECT_EQ(accurate.points_across, 0.0);
  EXPECT_EQ(accurate.cells_across, 0.0);
  EXPECT_EQ(accurate.shell.spacing, 0.002);
  EXPECT_EQ(accurate.shell.vertex_spacing, 0.0008);
  EXPECT_EQ(accurate.field.cell_size, 1.2 * 0.002);
  const BodyOptions cells = sceneOf("contact: {accuracy: 0.002}\nfield: {max_error: 0.001}\nshell: {edge_gap: 0.0005}");
  EXPECT_EQ(cells.field.max_error, 0.001);
  EXPECT_FALSE(cells.field.cell_size);
  EXPECT_EQ(cells.shell.spacing, 0.002);
  EXPECT_EQ(cells.shell.edge_gap, 0.0005);
  const BodyOptions points = sceneOf("shell: {spacing: 0.005}");
  EXPECT_EQ(points.points_across, 0.0);
  EXPECT_EQ(points.shell.vertex_spacing, 0.002);
  EXPECT_GT(points.cells_across, 0.0);
  EXPECT_NE(errorOf("contact: {accuracy: 0}").find("~/contact/accuracy is 0"), std::string::npos);
  EXPECT_NE(errorOf("field: {cell_size: 0.0002, max_error: 0.0002}").find("only one of cells"), std::string::npos);
}

TEST(Parameters, LimitsOfTheVelocityScaleNeedItsMaxSpeed) {
  const auto promise = [](const std::string& limits) {
    return parse("velocity_scale: {" + limits + "}").proximity.promise;
  };
  EXPECT_FALSE(promise("deceleration: 2.0"));  // the default
  EXPECT_EQ(promise("max_speed: 1.0, deceleration: 3.0").value().deceleration, 3.0);
  EXPECT_EQ(
      errorOf("velocity_scale: {deceleration: 3.0}"),
      "line 1: parameter ~/velocity_scale/max_speed is missing, expected a positive number, as other limits of the "
      "velocity scale are set");
}

TEST(Parameters, OwnPairsLimitAsMeasuredUnlessTheyPromise) {
  const auto rule = [](const std::string& own_pairs) {
    return parse("velocity_scale: {max_speed: 1.0" + own_pairs + "}").proximity.promise->own_pairs;
  };
  EXPECT_EQ(rule(""), OwnPairs::kMeasured);
  EXPECT_EQ(rule(", own_pairs: promise"), OwnPairs::kPromise);
  EXPECT_NE(errorOf("velocity_scale: {max_speed: 1.0, own_pairs: never}").find("~/velocity_scale/own_pairs"),
            std::string::npos);
  EXPECT_NE(errorOf("velocity_scale: {own_pairs: promise}").find("~/velocity_scale/max_speed is missing"),
            std::string::npos);
}

TEST(Parameters, PairsHaveTheirOwnStopDistance) {
  const std::vector<PairLimit> limits =
      parse("pairs: [{bodies: ['finger_*', part], stop_distance: 0.0}, {bodies: [a, b]}]").proximity.pairs;
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

TEST(Parameters, AMisspeltParameterOfAGroupIsRefused) {
  EXPECT_EQ(errorOf("world: [{name: ball, type: sphere, radius: 0.1, xzy: [1, 2, 3]}]"),
            "line 1: unknown parameter ~/world[0]/xzy, did you mean xyz?");
  EXPECT_EQ(errorOf("world: [{name: ball, type: sphere, raduis: 0.1}]"),
            "line 1: parameter ~/world[0]/radius is missing, expected a positive number; is it raduis?");
  EXPECT_NE(errorOf("world: [{name: ball, type: sphere, radius: 0.1, size: [1, 1, 1]}]").find("~/world[0]/size"),
            std::string::npos);
  EXPECT_EQ(errorOf("octomap: {fil: map.bt}"), "line 1: unknown parameter ~/octomap/fil, did you mean file?");
  EXPECT_EQ(errorOf("field: {cel_size: 0.001}"), "line 1: unknown parameter ~/field/cel_size, did you mean cell_size?");
  EXPECT_EQ(errorOf("shell: {spacin: 0.001}"), "line 1: unknown parameter ~/shell/spacin, did you mean spacing?");
  EXPECT_EQ(errorOf("contact: {dampin: 1.0}"), "line 1: unknown parameter ~/contact/dampin, did you mean damping?");
  // On a parameter server the node's namespace may hold parameters of others.
  const MonitorParameters parameters = parse("filed: {cell_size: 0.001}");
  EXPECT_EQ(parameters.unused, std::vector<std::string>{"~/filed, did you mean field?"});
}

TEST(Parameters, WhatIsGoneIsNamedWithWhatToDoInstead) {
  const MonitorParameters parameters = parse("allow_http: false\nfield: {sample_bits: 32, cells: 50}\nrat: 3");
  const std::vector<std::string> expected = {
      "~/allow_http, which is gone: nothing is read over the network: put meshes into files or packages",
      "~/field/sample_bits, which is gone: samples have 16 bits", "~/rat, did you mean rate?"};
  EXPECT_EQ(parameters.unused, expected);
  EXPECT_EQ(parameters.scene.field.cells, 50);
}

}  // namespace sdf_ccd::parameters_test
