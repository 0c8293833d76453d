// Cost of changing the world of a monitor that runs at 1 kHz: the time from a change to the first cycle checked with
// it, and the times of cycles before and meanwhile. Also a soak test of random changes, in which every version is
// compared with a new monitor.

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <map>
#include <random>

#include <unistd.h>

#include "monitor/map/voxel_map.h"
#include "precision/error_summary.h"
#include "study.h"
#include "world/running_monitor.h"

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kLinks = 12;

using precision::quantile;

/// Wall-clock time, and CPU time of this process on all cores, cycles included.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double processorSeconds() const { return double(std::clock() - processor_start_) / CLOCKS_PER_SEC; }

 private:
  Clock::time_point start_ = Clock::now();
  std::clock_t processor_start_ = std::clock();
};

/// Resident memory of this process [MB].
double residentMemory() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGE_SIZE)) / 1e6;
}

BodyDescription bodyOf(const std::string& name, const Primitive& primitive, bool is_world) {
  BodyDescription body;
  body.name = name;
  body.frame = is_world ? "world" : name;
  body.is_world = is_world;
  body.geometry.push_back({primitive, Isometry3d::Identity(), "shape", false});
  return body;
}

/// A swinging arm of boxes in a row.
std::vector<BodyDescription> links() {
  std::vector<BodyDescription> links;
  for (int i = 0; i < kLinks; ++i)
    links.push_back(bodyOf("link" + std::to_string(i), Box::fromSize({0.1, 0.08, 0.08}), false));
  return links;
}

Isometry3d placeOf(const BodyDescription& body, double time) {
  if (body.is_world) return body.X_frame_B;
  const int link = std::stoi(body.name.substr(4));
  const double angle = 0.6 * std::sin(2.0 * time);
  return Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * Eigen::Translation3d(0.12 * (link + 1), 0.0, 0.5);
}

/// The i-th box in the room around the arm, at least 0.2 m from the arm's swept volume.
BodyDescription object(int i, std::mt19937& random) {
  std::uniform_real_distribution<double> angle(1.2, 5.1), reach(0.4, 4.0), height(0.0, 2.0);
  const int kind = i % 8;  // boxes of eight sizes, like goods on shelves
  const Vector3d size(0.02 + 0.005 * kind, 0.05, 0.08 - 0.005 * kind);
  BodyDescription body = bodyOf("object" + std::to_string(i), Box::fromSize(2.0 * size), true);
  const double a = angle(random), r = reach(random);
  body.X_frame_B.translation() = Vector3d(r * std::cos(a), r * std::sin(a), height(random));
  return body;
}

/// A wavy ball of about so many triangles.
std::shared_ptr<const TriangleMesh> largeMesh(int triangles) {
  TriangleMesh mesh;
  const int rings = std::max(4, static_cast<int>(std::sqrt(triangles / 4.0))), sides = 2 * rings;
  const auto point = [&](int ring, int side) {
    const double u = M_PI * ring / rings, v = 2.0 * M_PI * side / sides;
    const double r = 0.2 + 0.01 * std::sin(8.0 * v) * std::pow(std::sin(u), 2);
    return Vector3d(r * std::sin(u) * std::cos(v), r * std::sin(u) * std::sin(v), r * std::cos(u));
  };
  mesh.vertices.push_back(point(0, 0));
  for (int ring = 1; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) mesh.vertices.push_back(point(ring, side));
  mesh.vertices.push_back(point(rings, 0));
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int ring, int side) { return 1 + (ring - 1) * sides + side % sides; };
  for (int side = 0; side < sides; ++side) {
    mesh.triangles.emplace_back(0, at(1, side), at(1, side + 1));
    mesh.triangles.emplace_back(last, at(rings - 1, side + 1), at(rings - 1, side));
    for (int ring = 1; ring + 1 < rings; ++ring) {
      mesh.triangles.emplace_back(at(ring, side), at(ring + 1, side), at(ring + 1, side + 1));
      mesh.triangles.emplace_back(at(ring, side), at(ring + 1, side + 1), at(ring, side + 1));
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

/// The walls and furniture of a room of 8 × 8 × 3 m in voxels of 50 mm; the arm stands in its centre.
class Room {
 public:
  static constexpr double kSize = 0.05;

  Room() {
    for (int x = -80; x < 80; ++x)
      for (int y = -80; y < 80; ++y) {
        const bool wall = x < -78 || x >= 78 || y < -78 || y >= 78;
        for (int z = -1; z < 60; ++z)
          if (wall || z < 0) voxels_.push_back({x, y, z});
      }
    for (int box = 0; box < 40; ++box) {
      const int x0 = -70 + (box * 37) % 130, y0 = box % 2 == 0 ? 40 : -60;
      for (int x = 0; x < 10; ++x)
        for (int y = 0; y < 10; ++y)
          for (int z = 0; z < 20; ++z) voxels_.push_back({x0 + x, y0 + y, z});
    }
  }

  /// A scan of the room with a column of `changed` more voxels, which is elsewhere in every scan.
  VoxelGrid scan(int changed, int time, const VoxelMapOptions& options) const {
    VoxelGrid grid(kSize, options);
    const Vector3i middle = Vector3i::Constant(1 << 15);
    for (const auto& v : voxels_) grid.add(middle + Vector3i(v[0], v[1], v[2]), 1, true);
    const int side = std::max(1, static_cast<int>(std::ceil(std::cbrt(changed / 4.0)))), height = 4 * side;
    int left = changed;
    for (int z = 0; z < height && left > 0; ++z)
      for (int y = 0; y < side && left > 0; ++y)
        for (int x = 0; x < side && left > 0; ++x, --left)
          grid.add(middle + Vector3i(-60 + 3 * (time % 20) + x, 25 + y, z), 1, true);
    return grid;
  }

  std::size_t size() const { return voxels_.size(); }

 private:
  std::vector<std::array<int, 3>> voxels_;
};

/// The world of a monitor in the room, kept up to date by scans of which `changed` voxels differ.
class MappedRoom {
 public:
  MappedRoom(int changed, const BodyOptions& accuracy)
      : changed_(changed), map_("map", "world", options()), editor_(accuracy) {}

  std::shared_ptr<const WorldSnapshot> take(int scan) {
    VoxelMap::Change change = map_.update(room_.scan(changed_, scan, options()), {});
    for (BodyDescription& tile : change.made) tiles_[tile.name] = std::move(tile);
    for (const std::string& gone : change.removed) tiles_.erase(gone);
    SceneDescription description{links(), {}};
    for (const auto& [tile, body] : tiles_) description.bodies.push_back(body);
    return editor_.next(std::move(description));
  }

  std::size_t tiles() const { return tiles_.size(); }
  std::size_t voxels() const { return room_.size(); }

 private:
  static VoxelMapOptions options() {
    VoxelMapOptions options;
    options.band = 0.06;
    return options;
  }

  int changed_;
  Room room_;
  VoxelMap map_;
  WorldEditor editor_;
  std::map<std::string, BodyDescription> tiles_;
};

class Study {
 public:
  explicit Study(const StudyOptions& options) : options_(options) {
    accuracy_.field.cells.reset();
    accuracy_.field.cell_size = 0.01;
    accuracy_.shell.spacing = 0.01;
    accuracy_.shell.edge_gap = 0.0;
    accuracy_.motion_margin = 1e-3;
  }

  void run() {
    for (const int count : {1, 10, 1000}) addObjects(count);
    addMesh();
    for (const int voxels : {1, 100, 2000, 10000, 100000}) changeMap(voxels);
    soak();
  }

 private:
  void row(const std::string& name, const std::string& metric, double value, const std::string& unit, int runs) const {
    print(Row{"world", name, "sdf_ccd", metric, value, unit, runs});
  }

  void report(const std::string& name, std::vector<double> seconds, RunningMonitor& monitor,
              std::vector<double> before) const {
    std::vector<double> meanwhile = monitor.takeTimes(), adoptions = monitor.takeAdoptions();
    std::vector<double> firsts = monitor.takeFirstTimes();
    const int runs = static_cast<int>(seconds.size());
    row(name, "ms_to_adopted", 1e3 * quantile(seconds, 0.5), "ms", runs);
    row(name, "ms_to_adopted_max", 1e3 * quantile(seconds, 1.0), "ms", runs);
    row(name, "adopt_us", 1e6 * quantile(adoptions, 0.5), "us", runs);
    row(name, "adopt_us_max", 1e6 * quantile(adoptions, 1.0), "us", runs);
    row(name, "first_cycle_us", 1e6 * quantile(firsts, 0.5), "us", runs);
    row(name, "first_cycle_us_max", 1e6 * quantile(firsts, 1.0), "us", runs);
    row(name, "cycle_us_p99_before", 1e6 * quantile(before, 0.99), "us", static_cast<int>(before.size()));
    row(name, "cycle_us_p99_while", 1e6 * quantile(meanwhile, 0.99), "us", static_cast<int>(meanwhile.size()));
    row(name, "cycle_us_median_before", 1e6 * quantile(before, 0.5), "us", static_cast<int>(before.size()));
    row(name, "cycle_us_median_while", 1e6 * quantile(meanwhile, 0.5), "us", static_cast<int>(meanwhile.size()));
  }

  std::vector<double> quietCycles(RunningMonitor& monitor) const {
    monitor.takeTimes();
    std::this_thread::sleep_for(std::chrono::milliseconds(options_.quick ? 300 : 2000));
    monitor.takeAdoptions();
    monitor.takeFirstTimes();
    return monitor.takeTimes();
  }

  /// Adds `count` objects at once to a world of as many, and removes them.
  void addObjects(int count) {
    const std::string name = "objects_" + std::to_string(count);
    if (!isWanted(options_.cases, name)) return;
    std::mt19937 random(1);
    SceneDescription few{links(), {}};
    for (int i = 0; i < count; ++i) few.bodies.push_back(object(i, random));
    SceneDescription many = few;
    for (int i = 0; i < count; ++i) many.bodies.push_back(object(count + i, random));
    measureChanges(name, few, [&](int i) { return i % 2 == 0 ? many : few; });
  }

  void addMesh() {
    const std::string name = "mesh_100000";
    if (!isWanted(options_.cases, name)) return;
    const SceneDescription without{links(), {}};
    measureChanges(name, without, [&](int i) {
      SceneDescription with = without;
      BodyDescription body = bodyOf("mesh" + std::to_string(i), Sphere{1.0}, true);
      body.geometry[0].shape = largeMesh(100000 + 4000 * i);  // a different mesh each time, so that no cache holds it
      body.X_frame_B.translation() = Vector3d(-1.0, 0.0, 0.5);
      with.bodies.push_back(body);
      return with;
    });
  }

  void measureChanges(const std::string& name, const SceneDescription& first,
                      const std::function<SceneDescription(int)>& next) {
    WorldEditor editor(accuracy_);
    RunningMonitor monitor(editor.next(first), placeOf);
    const std::vector<double> before = quietCycles(monitor);
    std::vector<double> seconds, processor;
    for (int i = 0; i < std::max(5, options_.measure.runs); ++i) {
      SceneDescription description = next(i);
      const Stopwatch watch;
      monitor.change(editor.next(std::move(description)));
      seconds.push_back(watch.seconds());
      processor.push_back(watch.processorSeconds());
    }
    row(name, "processor_ms", 1e3 * quantile(processor, 0.5), "ms", static_cast<int>(processor.size()));
    report(name, seconds, monitor, before);
  }

  /// Time from a voxel grid (as decoded from a message) to the first cycle that is checked with it, at 10 Hz.
  void changeMap(int changed) {
    const std::string name = "map_" + std::to_string(changed);
    if (!isWanted(options_.cases, name)) return;
    const auto begin = Clock::now();
    MappedRoom room(changed, accuracy_);
    const auto first = room.take(0);
    row(name, "ms_first", 1e3 * std::chrono::duration<double>(Clock::now() - begin).count(), "ms", 1);
    row(name, "tiles", double(room.tiles()), "tiles", 1);
    row(name, "voxels", double(room.voxels()), "voxels", 1);
    RunningMonitor monitor(first, placeOf);
    const std::vector<double> before = quietCycles(monitor);
    const auto scans = [&](const std::function<void(int)>& take) {
      for (int scan = 1; scan <= std::max(10, options_.measure.runs); ++scan) {
        const Stopwatch watch;
        take(scan);
        std::this_thread::sleep_for(std::chrono::milliseconds(100) - std::chrono::duration<double>(watch.seconds()));
      }
    };
    // The same work beside the cycles, whose world stays the same: how much a busy neighbour alone slows them down.
    MappedRoom other(changed, accuracy_);
    other.take(0);
    monitor.takeTimes();
    scans([&](int scan) { other.take(scan); });
    std::vector<double> beside = monitor.takeTimes();
    row(name, "cycle_us_p99_beside", 1e6 * quantile(beside, 0.99), "us", static_cast<int>(beside.size()));
    std::vector<double> seconds, processor;
    scans([&](int scan) {
      const Stopwatch watch;
      monitor.change(room.take(scan));
      seconds.push_back(watch.seconds());
      processor.push_back(watch.processorSeconds());
    });
    row(name, "processor_ms", 1e3 * quantile(processor, 0.5), "ms", static_cast<int>(processor.size()));
    report(name, seconds, monitor, before);
  }

  /// Random changes one after the other; the first cycle of every version is compared with that of a new monitor.
  void soak() {
    if (!isWanted(options_.cases, "soak")) return;
    std::mt19937 random(7);
    SceneDescription description{links(), {}};
    WorldEditor editor(accuracy_);
    RunningMonitor monitor(editor.next(description), placeOf);
    const double length = options_.quick ? 10.0 : 600.0;  // [s]
    const auto start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    long versions = 0, missed = 0, contacts = 0, differ = 0;
    double early = 0.0, late = 0.0;
    for (int i = 0; elapsed() < length; ++i) {
      std::vector<BodyDescription>& bodies = description.bodies;
      const std::size_t objects = bodies.size() - kLinks;
      const unsigned what = objects == 0 ? 0 : objects > 40 ? 1 : random() % 3;
      if (what == 0) bodies.push_back(object(i, random));
      const std::size_t any = kLinks + random() % std::max<std::size_t>(1, bodies.size() - kLinks);
      if (what == 1) bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(any));
      if (what == 2 || (what == 0 && random() % 3 == 0)) {  // into the arm's path, or elsewhere
        std::uniform_real_distribution<double> place(-1.5, 1.5);
        bodies[std::min(any, bodies.size() - 1)].X_frame_B.translation() = Vector3d(place(random), place(random), 0.5);
      }
      monitor.change(editor.next(description));
      const CycleVerdicts said = monitor.firstCycle();
      const CycleResult anew = Monitor(said.world->scene, {}).run(said.motion, {false, 0, false, false});
      for (std::size_t p = 0; p < anew.pairs.size(); ++p) {
        contacts += anew.pairs[p].verdict == Verdict::kContact;
        missed += anew.pairs[p].verdict == Verdict::kContact && said.verdicts[p] != Verdict::kContact;
        differ += anew.pairs[p].verdict != said.verdicts[p];
      }
      ++versions;
      monitor.takeTimes();
      monitor.takeAdoptions();
      if (elapsed() < 0.5 * length) early = std::max(early, residentMemory());
      late = std::max(late, residentMemory());
    }
    row("soak", "versions", double(versions), "versions", 1);
    row("soak", "contacts", double(contacts), "contacts", 1);
    row("soak", "contacts_missed", double(missed), "contacts", 1);
    row("soak", "verdicts_that_differ", double(differ), "verdicts", 1);
    row("soak", "rss_first_half", early, "MB", 1);
    row("soak", "rss", late, "MB", 1);
  }

  const StudyOptions& options_;
  BodyOptions accuracy_;
};

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.measure.runs = 20;
  StudyOptions quick = full;
  quick.measure.runs = 6;
  return runStudy(argc, argv, "What it costs to change a running monitor's world", full, quick,
                  [](const StudyOptions& options) { Study(options).run(); });
}
