#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btConvexHullComputer.h>

#include "monitor/monitor_system.h"

namespace sdf_ccd::benchmark {
namespace {

btVector3 toBullet(const Vector3d& v) {
  return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())};
}

btTransform toBullet(const Isometry3d& X) {
  const Matrix3d& R = X.linear();
  const auto at = [&](int row, int column) { return btScalar(R(row, column)); };
  const btMatrix3x3 rotation(at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2), at(2, 0), at(2, 1), at(2, 2));
  return btTransform(rotation, toBullet(X.translation()));
}

constexpr double kTessellation = 5e-4;  // error of tessellated spheres and cylinders [m]

/// The convex hulls of the collision elements. The hull of a non-convex mesh is larger than the mesh, so it reports
/// false contacts.
class BulletHulls : public MonitorSystem {
 public:
  BulletHulls(const SceneDescription& scene, const std::vector<PlannedPair>& pairs) : pairs_(pairs) {
    for (const BodyDescription& description : scene.bodies) {
      Hulls& body = bodies_.emplace_back();
      for (const GeometryDescription& geometry : description.geometry) body.elements.push_back(hullOf(geometry));
    }
  }

 protected:
  struct Element {
    std::shared_ptr<const btConvexHullShape> shape;  // in the body's frame
    btVector3 low, high;                             // in the world, over the time that is tested
  };
  struct Hulls {
    std::vector<Element> elements;
    btTransform start, end;
  };

  /// @param start  the poses at which the test begins; equal to `end` for a single time.
  void place(const std::vector<Isometry3d>& start, const std::vector<Isometry3d>& end) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      Hulls& body = bodies_[b];
      body.start = toBullet(start[b]);
      body.end = toBullet(end[b]);
      for (Element& element : body.elements) {
        btVector3 low, high;
        element.shape->getAabb(body.start, element.low, element.high);
        element.shape->getAabb(body.end, low, high);
        element.low.setMin(low);
        element.high.setMax(high);
      }
    }
  }

  /// Number of pairs of which two elements touch. @param touch  tests two elements whose boxes meet.
  template <class Touch>
  int countTouching(const Touch& touch) const {
    int touching = 0;
    for (const PlannedPair& pair : pairs_) touching += anyTouch(bodies_[pair.body_a], bodies_[pair.body_b], touch);
    return touching;
  }

  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depths_;

 private:
  static Element hullOf(const GeometryDescription& geometry) {
    const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
    const TriangleMesh& given = mesh ? **mesh : tessellate(std::get<Primitive>(geometry.shape), kTessellation);
    std::vector<btVector3> points;
    for (const Vector3d& v : given.vertices) points.push_back(toBullet(geometry.X_BG * v));
    btConvexHullComputer hull;
    hull.compute(&points.front()[0], int(sizeof(btVector3)), int(points.size()), 0.0f, 0.0f);
    const auto shape = std::make_shared<btConvexHullShape>(&hull.vertices[0][0], hull.vertices.size());
    shape->setMargin(0.0f);
    return {shape, {}, {}};
  }

  template <class Touch>
  static bool anyTouch(const Hulls& a, const Hulls& b, const Touch& touch) {
    for (const Element& one : a.elements) {
      for (const Element& other : b.elements) {
        const bool apart = one.low.x() > other.high.x() || other.low.x() > one.high.x() ||
                           one.low.y() > other.high.y() || other.low.y() > one.high.y() ||
                           one.low.z() > other.high.z() || other.low.z() > one.high.z();
        if (!apart && touch(a, one, b, other)) return true;
      }
    }
    return false;
  }

  std::vector<PlannedPair> pairs_;
  std::vector<Hulls> bodies_;
};

/// Bullet's continuous convex cast: conservative advancement in single precision.
class BulletCast : public BulletHulls {
 public:
  using BulletHulls::BulletHulls;
  std::string name() const override { return "bullet_cast"; }

  int check(const std::vector<Isometry3d>& X_WB_start, const std::vector<Isometry3d>& X_WB_end) override {
    place(X_WB_start, X_WB_end);
    return countTouching([&](const Hulls& a, const Element& one, const Hulls& b, const Element& other) {
      btContinuousConvexCollision cast(one.shape.get(), other.shape.get(), &simplex_, &depths_);
      btConvexCast::CastResult result;
      return cast.calcTimeOfImpact(a.start, a.end, b.start, b.end, result);
    });
  }
};

/// Bullet's discrete test at the cycle's end: GJK, and EPA for hulls that overlap.
class BulletDiscrete : public BulletHulls {
 public:
  using BulletHulls::BulletHulls;
  std::string name() const override { return "bullet"; }

  int check(const std::vector<Isometry3d>&, const std::vector<Isometry3d>& X_WB_end) override {
    place(X_WB_end, X_WB_end);
    return countTouching([&](const Hulls& a, const Element& one, const Hulls& b, const Element& other) {
      btGjkPairDetector detector(one.shape.get(), other.shape.get(), &simplex_, &depths_);
      btPointCollector nearest;
      btGjkPairDetector::ClosestPointInput input;
      input.m_transformA = a.end;
      input.m_transformB = b.end;
      detector.getClosestPoints(input, nearest, nullptr);
      return nearest.m_hasResult && nearest.m_distance <= 0.0f;
    });
  }
};

const RegisteredMonitorPeer kBullet{
    [](const SceneDescription& scene, const std::vector<PlannedPair>& pairs, MonitorSystems& systems) {
      systems.push_back(std::make_unique<BulletDiscrete>(scene, pairs));
      systems.push_back(std::make_unique<BulletCast>(scene, pairs));
    }};

}  // namespace
}  // namespace sdf_ccd::benchmark
