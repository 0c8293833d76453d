#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include "segment_system.h"

namespace sdf_ccd::benchmark {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

/// CGAL's AABB tree, in doubles. It returns first hits only for rays, so for a segment all hits are computed.
class Cgal : public SegmentSystem {
 public:
  explicit Cgal(const TriangleMesh& mesh) {
    const auto point = [&](int i) {
      const Vector3d& v = mesh.vertices[i];
      return Kernel::Point_3(v.x(), v.y(), v.z());
    };
    for (const Vector3i& t : mesh.triangles) triangles_.emplace_back(point(t.x()), point(t.y()), point(t.z()));
    tree_.rebuild(triangles_.cbegin(), triangles_.cend());
  }

  std::string name() const override { return "cgal"; }
  std::size_t bytes() const override { return 0; }

  long run(const Segment* segments, std::size_t count, const Question& question) override {
    long answers = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d &a = segments[i].start, &b = segments[i].end;
      const Kernel::Segment_3 segment({a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()});
      if (question.find == Find::kAny) {
        answers += tree_.do_intersect(segment);
        continue;
      }
      hits_.clear();
      tree_.all_intersections(segment, std::back_inserter(hits_));
      answers += question.find == Find::kAll ? long(hits_.size()) : long(!hits_.empty());
    }
    return answers;
  }

 private:
  Triangles triangles_;
  Tree tree_;
  std::vector<Tree::Intersection_and_primitive_id<Kernel::Segment_3>::Type> hits_;
};

const Registered kCgal{MeshFactory(
    [](const TriangleMesh& mesh, SegmentSystems& systems) { systems.push_back(std::make_unique<Cgal>(mesh)); })};

}  // namespace
}  // namespace sdf_ccd::benchmark
