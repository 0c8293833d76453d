#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

/// Counts hits: of all triangles, or only those nearer than the previous ones (which finds the first hit).
struct CountHits : btTriangleRaycastCallback {
  CountHits(const btVector3& from, const btVector3& to, bool all) : btTriangleRaycastCallback(from, to), all(all) {}

  btScalar reportHit(const btVector3&, btScalar fraction, int, int) override {
    ++hits;
    return all ? m_hitFraction : fraction;
  }

  bool all;
  long hits = 0;
};

/// Ray casts with Bullet's quantised bounding volume hierarchy of the triangles.
class Bullet : public SegmentSystem {
 public:
  explicit Bullet(const TriangleMesh& mesh) {
    for (const Vector3d& v : mesh.vertices) points_.emplace_back(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
    for (const Vector3i& t : mesh.triangles) indices_.insert(indices_.end(), t.data(), t.data() + 3);
    triangles_ =
        std::make_unique<btTriangleIndexVertexArray>(int(mesh.triangles.size()), indices_.data(), int(3 * sizeof(int)),
                                                     int(points_.size()), &points_.front()[0], int(sizeof(btVector3)));
    shape_ = std::make_unique<btBvhTriangleMeshShape>(triangles_.get(), true);
  }

  std::string name() const override { return "bullet"; }
  std::size_t bytes() const override {
    return points_.size() * sizeof(btVector3) + indices_.size() * sizeof(int) +
           shape_->getOptimizedBvh()->calculateSerializeBufferSize();
  }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    const bool all = question.find == Find::kAll;
    long answers = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const long hits = cast(segments[i], all).hits;
      answers += all ? hits : hits > 0;
    }
    return answers;
  }

  bool tellsTimes() const override { return true; }
  void firstTimes(const std::vector<Segment>& segments, std::vector<double>& times) override {
    times.resize(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const CountHits found = cast(segments[i], false);
      times[i] = found.hits > 0 ? double(found.m_hitFraction) : -1.0;
    }
  }

 private:
  CountHits cast(const Segment& segment, bool all) const {
    const Vector3d &a = segment.start, &b = segment.end;
    const btVector3 from(btScalar(a.x()), btScalar(a.y()), btScalar(a.z()));
    const btVector3 to(btScalar(b.x()), btScalar(b.y()), btScalar(b.z()));
    CountHits callback(from, to, all);
    shape_->performRaycast(&callback, from, to);
    return callback;
  }

  std::vector<btVector3> points_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> triangles_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

const Registered kBullet{MeshFactory(
    [](const TriangleMesh& mesh, SegmentSystems& systems) { systems.push_back(std::make_unique<Bullet>(mesh)); })};

}  // namespace
}  // namespace sdf_ccd::benchmark
