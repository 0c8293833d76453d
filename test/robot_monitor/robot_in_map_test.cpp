// A real arm sweeps through a real map. OctoMap itself gives the expected occupancy.
#ifdef SDF_CCD_WITH_OCTOMAP

#include <gtest/gtest.h>

#include <cstdlib>
#include <unordered_set>

#include <octomap/OcTree.h>

#include "oracle/files.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "robot_monitor/check_motion.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::robot_in_map_test {

const std::string kMap = "octomaps/geb079.bt";
const std::string kUrdf = "robots/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf";
const std::string kSrdf = "robots/example-robot-data/robots/ur_description/srdf/ur5.srdf";

/// The occupied voxels of a map, from OctoMap.
class Occupied {
 public:
  explicit Occupied(const std::string& file) {
    octomap::OcTree tree(file);
    tree.expand();
    size_ = tree.getResolution();
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      if (!tree.isNodeOccupied(*leaf)) continue;
      voxels_.push_back((Vector3d(leaf.getX(), leaf.getY(), leaf.getZ()) / size_).array().floor().cast<int>());
      known_.insert(keyOf(voxels_.back()));
    }
  }

  double size() const { return size_; }

  /// Signed distance, exact up to two voxels on either side; beyond that ±kBeyond.
  static constexpr double kBeyond = 1.0;
  double distance(const Vector3d& p) const {
    const Vector3i voxel = (p / size()).array().floor().cast<int>();
    const bool is_in = isIn(voxel);
    double least = 2.0 * size();
    for (Vector3i d(-2, -2, -2); d.z() <= 2; ++d.z())
      for (d.y() = -2; d.y() <= 2; ++d.y())
        for (d.x() = -2; d.x() <= 2; ++d.x()) {
          if (isIn(voxel + d) == is_in) continue;
          const Vector3d low = size() * (voxel + d).cast<double>();
          least = std::min(least, AlignedBox3d(low, low + Vector3d::Constant(size())).exteriorDistance(p));
        }
    const double distance = least < 2.0 * size() ? least : kBeyond;
    return is_in ? -distance : distance;
  }

  /// Centre of a random occupied voxel.
  Vector3d any(test::Random& random) const {
    std::uniform_int_distribution<std::size_t> pick(0, voxels_.size() - 1);
    return size_ * (voxels_[pick(random)].cast<double>().array() + 0.5);
  }

 private:
  static std::int64_t keyOf(const Vector3i& v) {
    return (std::int64_t{v.z()} + 32768) << 40 | (std::int64_t{v.y()} + 32768) << 20 | (std::int64_t{v.x()} + 32768);
  }
  bool isIn(const Vector3i& voxel) const { return known_.count(keyOf(voxel)) > 0; }

  double size_ = 0.0;
  std::vector<Vector3i> voxels_;
  std::unordered_set<std::int64_t> known_;
};

/// Points on the surface of a body, in its frame, about `spacing` apart.
std::vector<Vector3d> surfacePoints(const BodyDescription& body, double spacing) {
  std::vector<Vector3d> points;
  for (const GeometryDescription& geometry : body.geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    const TriangleMesh mesh = primitive ? test::boxMesh(std::get<Box>(*primitive).halfSize())
                                        : *std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape);
    for (const Vector3i& t : mesh.triangles) {
      const Vector3d a = mesh.vertices[t[0]], u = mesh.vertices[t[1]] - a, v = mesh.vertices[t[2]] - a;
      const int n = 1 + int(std::max({u.norm(), v.norm(), (u - v).norm()}) / spacing);
      for (int i = 0; i <= n; ++i)
        for (int k = 0; i + k <= n; ++k) points.push_back(geometry.X_BG * (a + double(i) / n * u + double(k) / n * v));
    }
  }
  return points;
}

class RobotInMap : public ::testing::Test {
 protected:
  void load() {
    ::setenv("ROS_PACKAGE_PATH", test::dataPath("robots").c_str(), 1);
    const PackageFinder packages = packagesFromEnvironment();
    const ResourceLoader loader = [&](const std::string& uri) { return loadLocalResource(uri, packages, ""); };
    robot_ = std::make_unique<RobotModel>(test::readText(test::dataPath(kUrdf)));
    std::vector<std::string> warnings;
    description_ = describeRobot(*robot_, parseSrdf(test::readText(test::dataPath(kSrdf))), loader, {}, warnings);
    for (const BodyDescription& body : description_.bodies) points_.push_back(surfacePoints(body, 0.04));
    double size = 0.0;
    BodyDescription map;
    map.name = "octomap";
    map.frame = "map";
    map.is_world = true;
    GeometryDescription voxels;
    voxels.shape = std::make_shared<const TriangleMesh>(loadOctomapSurface(test::dataPath(kMap), size));
    voxels.watertight_voxels = true;
    voxels.cell_size = 0.5 * size;
    map.geometry.push_back(voxels);
    description_.bodies.push_back(map);
    const BodyOptions options = optionsFor(Accuracy{5e-3});
    scene_ =
        std::make_shared<const Scene>(buildScene(description_, planScene(description_, planOptions(options)), options));
  }

  /// Pose of each body for a robot whose root is at X_WR; the map stays in place.
  std::vector<Isometry3d> posesOf(const Isometry3d& X_WR, const JointPositions& positions) const {
    const std::vector<Isometry3d> X_RL = robot_->forwardKinematics(positions);
    const std::vector<std::string>& links = robot_->links();
    std::vector<Isometry3d> poses;
    for (const BodyDescription& body : description_.bodies) {
      const auto link = static_cast<std::size_t>(std::find(links.begin(), links.end(), body.name) - links.begin());
      poses.push_back(body.is_world ? Isometry3d::Identity() : Isometry3d(X_WR * X_RL[link]));
    }
    return poses;
  }

  double leastDistance(const Occupied& occupied, const std::vector<Isometry3d>& poses, std::size_t body) const {
    double least = Occupied::kBeyond;
    for (const Vector3d& p : points_[body]) least = std::min(least, occupied.distance(poses[body] * p));
    return least;
  }

  std::unique_ptr<RobotModel> robot_;
  SceneDescription description_;
  std::vector<std::vector<Vector3d>> points_;  // per body of the robot, in its frame
  std::shared_ptr<const Scene> scene_;
};

TEST_F(RobotInMap, SweepsAreCaughtAtTheRightVoxels) {
  SDF_CCD_NEEDS_DATA(kMap);
  SDF_CCD_NEEDS_DATA(kUrdf);
  load();
  const Occupied occupied(test::dataPath(kMap));
  test::Random random(7);
  constexpr int kSteps = 12;
  int caught = 0, deep = 0, clear = 0, open = 0;
  for (int sweep = 0; sweep < 15; ++sweep) {
    // Close to an occupied voxel, where robots usually stand.
    Isometry3d X_WR = Isometry3d::Identity();
    X_WR.translation() =
        occupied.any(random) +
        Vector3d(test::uniform(random, -0.8, 0.8), test::uniform(random, -0.8, 0.8), test::uniform(random, -0.5, 0.3));
    JointPositions positions = {{"shoulder_pan_joint", test::uniform(random, -3.0, 3.0)},
                                {"shoulder_lift_joint", test::uniform(random, -2.0, 0.0)},
                                {"elbow_joint", test::uniform(random, -1.5, 1.5)}};
    Monitor monitor(scene_, {});
    std::vector<Isometry3d> before = posesOf(X_WR, positions);
    for (int step = 0; step < kSteps; ++step) {
      positions["shoulder_pan_joint"] += 0.05;
      positions["elbow_joint"] += 0.03;
      const std::vector<Isometry3d> now = posesOf(X_WR, positions);
      std::vector<std::vector<Isometry3d>> motion;
      for (std::size_t b = 0; b < now.size(); ++b) motion.push_back({before[b], now[b]});
      const CycleResult& result = monitor.check(motion, 0.02);
      for (std::size_t p = 0; p < result.pairs.size(); ++p) {
        const PairResult& pair = result.pairs[p];
        if (!scene_->bodies[pair.body_b].is_world) continue;
        ASSERT_NE(pair.verdict, Verdict::kNotChecked) << scene_->bodies[pair.body_a].name << ": " << pair.reason;
        const auto link = static_cast<std::size_t>(pair.body_a);
        const double bound = pair.error.total();
        EXPECT_LT(bound, 1e-4) << "triangles decide about voxels";
        const double at_end = leastDistance(occupied, now, link);
        if (at_end < -bound) {
          ++deep;
          EXPECT_NE(pair.verdict, Verdict::kClear) << sweep << " " << step << " " << scene_->bodies[link].name;
        }
        clear += pair.verdict == Verdict::kClear;
        open += pair.verdict == Verdict::kUncertain;
        if (pair.verdict != Verdict::kContact) continue;
        ++caught;
        const double distance = occupied.distance(pair.deepest.p_W), depth_bound = pair.contact_error.total();
        EXPECT_LT(distance, depth_bound) << sweep << " " << step;
        if (distance == -Occupied::kBeyond) {
          EXPECT_GT(pair.deepest.depth, 2.0 * occupied.size() - depth_bound);
        } else {
          EXPECT_NEAR(-distance, pair.deepest.depth, depth_bound) << sweep << " " << step;
        }
      }
      before = now;
    }
  }
  EXPECT_GT(caught, 100);
  EXPECT_GT(deep, 30);
  EXPECT_GT(clear, 100);
  EXPECT_EQ(open, 0);
}

}  // namespace sdf_ccd::robot_in_map_test

#endif
