#include "ros/parameters/parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "common/number_text.h"
#include "dynamics/scene_settings.h"
#include "ros/parameters/server_parameters.h"
#include "ros/parameters/world_parameters.h"
#include "scene/body_options.h"
#include "scene/error_budget.h"

namespace sdf_ccd {
namespace {

constexpr double kPreparationTime = 20.0;   // of a body [s]
constexpr double kLongestRequest = 3600.0;  // [s]
constexpr double kLongestCycle = 3600.0;    // transforms have to be kept for that long [s]
constexpr std::size_t kMaxRules = 1000;     // each is matched with each pair
constexpr double kByRate = -1.0;            // max_cycle_time: a share of the period

std::vector<PairRule> readRules(SettingsReader& reader, const std::string& key) {
  std::vector<PairRule> rules;
  for (const auto& [a, b] : reader.textPairs(key)) rules.push_back({a, b});
  if (rules.size() > kMaxRules) reader.fail(key, "at most " + std::to_string(kMaxRules) + " pairs");
  return rules;
}

/// Options of fields and shells for contacts: their resolution follows contact/accuracy or else the sizes of the
/// elements; the parameters field and shell override it.
BodyOptions readScene(SettingsReader& reader, SettingsReader& contact) {
  std::optional<double> accuracy;
  if (contact.has("accuracy")) accuracy = contact.positive("accuracy");
  BodyOptions scene = optionsForContacts(accuracy);

  SettingsReader field = reader.group("field");
  const int given = field.has("cells") + field.has("cell_size") + field.has("max_error");
  if (given > 1) field.fail("cells", "only one of cells, cell_size and max_error to be set");
  if (given > 0) setFieldResolution({}, scene);
  if (field.has("cells")) scene.field.cells = field.integer("cells", {}, 2);
  if (field.has("max_error")) scene.field.max_error = field.positive("max_error");
  if (field.has("cell_size")) scene.field.cell_size = field.positive("cell_size");
  scene.field.band = field.notNegative("band", scene.field.band);
  const double megabytes = field.positive("max_megabytes", static_cast<double>(scene.field.max_bytes >> 20));
  scene.field.max_bytes = static_cast<std::size_t>(megabytes * (1 << 20));
  field.finish();

  SettingsReader shell = reader.group("shell");
  if (shell.has("spacing")) setShellSpacing(shell.positive("spacing"), scene);
  scene.shell.edge_gap = shell.notNegative("edge_gap", scene.shell.edge_gap);
  scene.shell.vertex_spacing = shell.notNegative("vertex_spacing", scene.shell.vertex_spacing);
  scene.shell.seed = shell.integer("seed", static_cast<int>(scene.shell.seed), 0);
  shell.finish();
  return scene;
}

/// Sets the error bound of verdicts, and the part of it for motions between transforms.
void readMaxError(SettingsReader& reader, MonitorParameters& parameters) {
  double& max_error = parameters.monitor.max_error;
  max_error = reader.positive("max_error", max_error);
  if (max_error < kMinMaxError || max_error > kLargestMaxError)
    reader.fail("max_error", "from " + numberText(kMinMaxError) + " to " + numberText(kLargestMaxError) + " m");
  if (reader.has("max_error")) parameters.scene.max_error = max_error;
  ChordOptions& chords = parameters.monitor.chords;
  double& sampling = parameters.tf.sampling.tolerance;
  sampling = samplingTolerance(max_error, chords.tolerance);
  if (reader.has("chord_tolerance")) sampling = chords.tolerance = reader.positive("chord_tolerance");
  setMotionErrors(sampling, chords.tolerance, parameters.scene);
}

/// What holds for single pairs: `pairs: [{bodies: [a, b], stop_distance: …}]`.
std::vector<PairLimit> readPairLimits(SettingsReader& reader) {
  std::vector<PairLimit> limits;
  for (SettingsReader& entry : reader.list("pairs")) {
    const std::vector<std::string> bodies = entry.texts("bodies");
    if (bodies.size() != 2) entry.fail("bodies", "two names or patterns of bodies");
    PairLimit limit{{bodies[0], bodies[1]}};
    if (entry.has("stop_distance")) limit.stop_distance = entry.notNegative("stop_distance");
    entry.finish();
    limits.push_back(limit);
  }
  if (limits.size() > kMaxRules) reader.fail("pairs", "at most " + std::to_string(kMaxRules) + " entries");
  return limits;
}

ProximityParameters readProximity(SettingsReader& reader) {
  ProximityParameters proximity;
  proximity.report_distance = reader.notNegative("report_distance", 0.0);
  ProximityThresholds& thresholds = proximity.thresholds;
  thresholds.warning = reader.notNegative("warning_distance", 0.0);
  thresholds.stop = reader.notNegative("stop_distance", 0.0);
  thresholds.hysteresis = reader.notNegative("hysteresis", 0.005);
  if (thresholds.warning > 0.0 && thresholds.warning < thresholds.stop) {
    reader.fail("warning_distance", "no less than stop_distance");
  }
  proximity.pairs = readPairLimits(reader);
  SettingsReader scale = reader.group("velocity_scale");
  StoppingPromise promise;
  promise.stop_distance = thresholds.stop;
  const bool is_wanted = scale.has("max_speed");
  promise.max_speed = scale.positive("max_speed", promise.max_speed);
  promise.max_acceleration = scale.notNegative("max_acceleration", promise.max_acceleration);
  promise.deceleration = scale.positive("deceleration", promise.deceleration);
  promise.reaction_time = scale.notNegative("reaction_time", promise.reaction_time);
  promise.period = scale.positive("period", promise.period);
  promise.max_age = scale.positive("max_age", promise.max_age);
  promise.own_pairs = scale.choice("own_pairs", {"measured", "promise"}, promise.own_pairs);
  scale.finish();
  const auto limits = [](const StoppingPromise& p) {
    return std::tie(p.max_acceleration, p.deceleration, p.reaction_time, p.period, p.max_age, p.own_pairs);
  };
  if (!is_wanted && limits(promise) != limits(StoppingPromise()))
    scale.fail("max_speed", "a positive number, as other limits of the velocity scale are set");
  if (is_wanted) proximity.promise = promise;
  return proximity;
}

TriggerOptions readTrigger(SettingsReader& reader, const MonitorParameters& parameters) {
  TriggerOptions trigger;
  trigger.kind = reader.choice("trigger", {"timer", "tf", "joint_states", "frames"}, trigger.kind);
  for (const std::string& frame : reader.texts("trigger_frames")) trigger.frames.push_back(withoutLeadingSlash(frame));
  if (trigger.kind == TriggerKind::kFrames && trigger.frames.empty()) {
    reader.fail("trigger_frames", "one frame or more, as trigger is frames");
  }
  trigger.period = 1.0 / parameters.rate;
  // Limits the wait, so that the tracker can report frames that have stopped.
  trigger.patience = std::min(0.1, parameters.tf.max_latency);
  return trigger;
}

ContactJoin readJoin(SettingsReader& reader, const ContactJoin& preset) {
  const double time = reader.notNegative("join_time", std::chrono::duration<double>(preset.time).count());
  if (time > kLongestCycle) reader.fail("join_time", "at most an hour");
  const auto rounded = std::chrono::nanoseconds(std::llround(1e9 * time));
  return {std::max(ContactTracker::kJoin, rounded), reader.notNegative("join_distance", preset.distance)};
}

RequestPermissions readRequests(SettingsReader reader) {
  RequestPermissions requests;
  if (reader.has("allow")) {
    try {
      requests = permissionsOf(reader.texts("allow"));
    } catch (const std::invalid_argument&) {
      reader.fail("allow", "a list of add, move, attach, rules, clear, reset and limits");
    }
  }
  requests.protected_bodies = reader.texts("protected");
  reader.finish();
  return requests;
}

std::optional<WorldObject> readOctomap(SettingsReader reader, LiveMapParameters& live) {
  live.topic = reader.name("topic", "");
  live.unknown = reader.choice("unknown", {"free", "occupied", "occupied_near"}, live.unknown);
  live.unknown_distance = reader.notNegative("unknown_distance", live.unknown_distance);
  live.padding = reader.notNegative("padding", live.padding);
  live.max_age = reader.notNegative("max_age", live.max_age);
  OctomapObject map{reader.text("file", "")};
  WorldObject object{"octomap", reader.name("frame", ""), readPose(reader), {}};
  map.cell_size = reader.notNegative("cell_size", map.cell_size);
  reader.finish();
  if (map.uri.empty()) return std::nullopt;
  object.shapes.push_back({map});
  return object;
}

std::string defaultCacheDirectory() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) return std::string(cache) + "/sdf_ccd";
  if (const char* home = std::getenv("HOME"); home && *home) return std::string(home) + "/.cache/sdf_ccd";
  return "";
}

/// The text of a parameter, searched for upwards from the private namespace: `~/…`, then `/ns/…`, then `/…`;
/// empty if there is none.
std::string findDescription(const ros::NodeHandle& private_node, const std::string& name) {
  std::string key, text;
  if (private_node.searchParam(name, key)) private_node.getParam(key, text);
  return text;
}

/// Parameters of earlier versions, and what to do instead.
struct GoneParameter {
  const char *group, *key, *instead;
};
constexpr GoneParameter kGone[] = {
    {"", "allow_http", "nothing is read over the network: put meshes into files or packages"},
    {"", "refine", "all contacts are measured on surfaces"},
    {"field", "sample_bits", "samples have 16 bits"},
};

/// Takes the gone parameters out of the tree. @return a text about each.
std::vector<std::string> takeGone(Setting& tree, const std::string& name) {
  std::vector<std::string> texts;
  for (const GoneParameter& gone : kGone) {
    const bool is_in_group = *gone.group != 0;
    auto* group = std::get_if<Setting::Group>(&tree.value);
    if (group && is_in_group) {
      const auto found = group->find(gone.group);
      group = found == group->end() ? nullptr : std::get_if<Setting::Group>(&found->second.value);
    }
    if (!group || group->erase(gone.key) == 0) continue;
    texts.push_back(name + "/" + (is_in_group ? std::string(gone.group) + "/" : "") + gone.key +
                    ", which is gone: " + gone.instead);
  }
  return texts;
}

}  // namespace

MonitorParameters parseParameters(Setting tree, const std::string& name) {
  MonitorParameters parameters;
  parameters.unused = takeGone(tree, name);
  SettingsReader reader(std::move(tree), name);

  parameters.urdf_parameter = reader.text("urdf_parameter", "robot_description");
  parameters.srdf_parameter = reader.text("srdf_parameter", parameters.urdf_parameter + "_semantic");
  parameters.urdf_file = reader.text("urdf_file", "");
  if (!parameters.urdf_file.empty() && parameters.urdf_file[0] != '/')
    reader.fail("urdf_file", "the absolute path of a file");
  parameters.fixed_frame = withoutLeadingSlash(reader.name("fixed_frame", ""));
  parameters.tf_prefix = withoutLeadingSlash(reader.name("tf_prefix", ""));
  parameters.robot.check_adjacent = reader.flag("check_adjacent", false);

  parameters.pairs = {readRules(reader, "allowed_pairs"), readRules(reader, "checked_pairs")};
  parameters.overlapping_pairs =
      reader.choice("overlapping_pairs", {"neighbours", "rest", "leave_out", "check"}, parameters.overlapping_pairs);

  parameters.wrenches = reader.choice("wrenches", {"always", "on_demand", "never"}, parameters.wrenches);

  parameters.world = readWorld(reader);
  parameters.world_file = reader.text("world_file", "");
  parameters.resource_roots = reader.texts("resource_roots");
  for (const std::string& root : parameters.resource_roots)
    if (root.empty() || root[0] != '/') reader.fail("resource_roots", "absolute paths of folders");
  parameters.requests = readRequests(reader.group("requests"));
  parameters.request_time = reader.positive("request_time", parameters.request_time);
  if (parameters.request_time > kLongestRequest) reader.fail("request_time", "at most an hour");
  parameters.octomap = readOctomap(reader.group("octomap"), parameters.live_map);
  SettingsReader contact = reader.group("contact");
  parameters.scene = readScene(reader, contact);
  parameters.scene.max_preparation_time = reader.positive("max_preparation_time", kPreparationTime);
  if (reader.flag("cache", true)) {
    parameters.scene.cache_directory = reader.text("cache_directory", "");
    if (parameters.scene.cache_directory.empty()) parameters.scene.cache_directory = defaultCacheDirectory();
  } else {
    reader.text("cache_directory", "");
  }

  parameters.monitor.contact = readContact(contact);
  parameters.contact_join = readJoin(contact, parameters.contact_join);
  contact.finish();
  readMaxError(reader, parameters);
  ChordOptions& chords = parameters.monitor.chords;
  chords.max_chords = reader.integer("max_chords", chords.max_chords, 1);
  parameters.tf.max_latency = reader.positive("max_latency", parameters.tf.max_latency);
  parameters.tf.max_cycle = reader.positive("max_cycle", parameters.tf.max_cycle);
  for (const char* key : {"max_latency", "max_cycle"}) {
    if (reader.positive(key, 1.0) > kLongestCycle) reader.fail(key, "at most an hour");
  }
  parameters.rate = reader.positive("rate", 30.0);
  parameters.max_cycle_time = reader.number("max_cycle_time", kByRate);
  const std::string no_time = whyNoCycleTime(parameters.max_cycle_time);
  if (!no_time.empty()) reader.fail("max_cycle_time", no_time);
  parameters.trigger = readTrigger(reader, parameters);

  parameters.proximity = readProximity(reader);
  if (parameters.proximity.promise) parameters.proximity.promise->map_distance = parameters.live_map.padding;
  parameters.max_points = reader.integer("max_points", 20, 0);
  parameters.log_contacts = reader.flag("log_contacts", true);
  parameters.markers.scale = reader.positive("marker_scale", parameters.markers.scale);
  parameters.markers.hold = reader.notNegative("marker_hold", parameters.markers.hold);
  // The descriptions may also be set in this namespace.
  for (const std::string& description : {parameters.urdf_parameter, parameters.srdf_parameter})
    reader.text(description, "");
  reader.integer("num_worker_threads", 0, 0);  // the nodelet loader's
  reader.positive("diagnostic_period", 1.0);   // the diagnostic updater's
  for (const std::string& unknown : reader.unread()) parameters.unused.push_back(unknown);
  return parameters;
}

std::string whyNoCycleTime(double max_cycle_time) {
  const bool is_limit = max_cycle_time >= 0.0 && std::isfinite(max_cycle_time);
  return is_limit || max_cycle_time == kByRate ? "" : "-1 for 0.8 / rate, 0 for no limit, or a number of seconds";
}

double cycleTimeLimit(const MonitorParameters& parameters) {
  constexpr double kShare = 0.8;
  return parameters.max_cycle_time == kByRate ? kShare / parameters.rate : parameters.max_cycle_time;
}

MonitorParameters readParameters(const ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue tree;
  private_node.getParam("", tree);
  MonitorParameters parameters = parseParameters(toSetting(tree), private_node.getNamespace());
  parameters.urdf = findDescription(private_node, parameters.urdf_parameter);
  if (parameters.urdf.empty()) {
    throw MissingDescription("parameter " + parameters.urdf_parameter + " is missing, expected a robot's URDF");
  }
  parameters.srdf = findDescription(private_node, parameters.srdf_parameter);
  parameters.urdf_source = "parameter " + parameters.urdf_parameter;
  parameters.srdf_source = "parameter " + parameters.srdf_parameter;
  return parameters;
}

}  // namespace sdf_ccd
