#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "mesh/corners.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/triangle_distance.h"
#include "sdf_ccd/distances.h"

/// Distances, gaps and closing speeds of PairDistances against closed forms in long double: of solids of 1 mm to 10 m,
/// at poses that are drawn, and at those that a climb finds where the results are nearest to being wrong.
namespace sdf_ccd::exact_distances_test {

using test::Random;
using test::Real;
using test::uniform;
using test::Vector3r;

using Solid = std::vector<Primitive>;  // about the origin of the body

struct Pose {
  explicit Pose(const Isometry3d& X) : R(X.linear().cast<Real>()), p(X.translation().cast<Real>()) {}
  Vector3r into(const Vector3r& q) const { return R.transpose() * (q - p); }
  Eigen::Matrix<Real, 3, 3> R;
  Vector3r p;
};

/// Signed distance of a point in the solid's frame.
Real signedDistance(const Primitive& primitive, const Vector3r& p) {
  if (const auto* sphere = std::get_if<Sphere>(&primitive)) return p.norm() - Real(sphere->radius);
  if (const auto* plane = std::get_if<HalfSpace>(&primitive))
    return plane->normal.cast<Real>().dot(p) - Real(plane->offset);
  if (const auto* box = std::get_if<Box>(&primitive)) {
    const Vector3r q = p.cwiseAbs() - Real(0.5) * box->size.cast<Real>();
    return q.cwiseMax(Real(0)).norm() + std::min<Real>(q.maxCoeff(), 0);
  }
  const auto& cylinder = std::get<Cylinder>(primitive);
  const Real radial = std::hypot(p.x(), p.y()) - Real(cylinder.radius);
  const Real axial = std::abs(p.z()) - Real(0.5) * Real(cylinder.length);
  return std::hypot(std::max<Real>(radial, 0), std::max<Real>(axial, 0)) + std::min<Real>(std::max(radial, axial), 0);
}

Real signedDistance(const Solid& solid, const Pose& X, const Vector3r& p) {
  Real least = 1e300L;
  for (const Primitive& part : solid) least = std::min(least, signedDistance(part, X.into(p)));
  return least;
}

/// The largest n·p of the solid's points.
Real support(const Primitive& primitive, const Pose& X, const Vector3r& n) {
  const Vector3r m = X.R.transpose() * n;
  const Real middle = n.dot(X.p);
  if (const auto* sphere = std::get_if<Sphere>(&primitive)) return middle + Real(sphere->radius);
  if (const auto* box = std::get_if<Box>(&primitive))
    return middle + Real(0.5) * m.cwiseAbs().dot(box->size.cast<Real>());
  if (const auto* cylinder = std::get_if<Cylinder>(&primitive))
    return middle + Real(cylinder->radius) * std::hypot(m.x(), m.y()) +
           Real(0.5) * Real(cylinder->length) * std::abs(m.z());
  const auto& plane = std::get<HalfSpace>(primitive);
  const Vector3r out = plane.normal.cast<Real>();
  return (m - out).norm() < 1e-9 ? middle + Real(plane.offset) : Real(1e300L);
}

Real support(const Solid& solid, const Pose& X, const Vector3r& n) {
  Real most = -1e300L;
  for (const Primitive& part : solid) most = std::max(most, support(part, X, n));
  return most;
}

std::vector<test::Triangle3r> facesOf(const Box& box, const Isometry3d& X) {
  const TriangleMesh mesh = tessellate(box, 1.0);
  std::vector<test::Triangle3r> faces;
  for (int i = 0; i < int(mesh.triangles.size()); ++i) faces.push_back(test::exact(cornersOf(mesh, i), X));
  return faces;
}

/// Exact distance; 0 if they overlap. One of the two is a sphere or a half-space, or both are boxes.
Real distanceOf(const Primitive& a, const Isometry3d& X_WA, const Primitive& b, const Isometry3d& X_WB) {
  const Pose A(X_WA), B(X_WB);
  if (const auto* sphere = std::get_if<Sphere>(&a))
    return std::max<Real>(0, signedDistance(b, B.into(A.p)) - Real(sphere->radius));
  if (std::holds_alternative<Sphere>(b)) return distanceOf(b, X_WB, a, X_WA);
  if (const auto* plane = std::get_if<HalfSpace>(&b)) {
    const Vector3r out = B.R * plane->normal.cast<Real>();
    return std::max<Real>(0, -support(a, A, -out) - out.dot(B.p) - Real(plane->offset));
  }
  if (std::holds_alternative<HalfSpace>(a)) return distanceOf(b, X_WB, a, X_WA);
  if (signedDistance(a, A.into(B.p)) <= 0 || signedDistance(b, B.into(A.p)) <= 0) return 0;
  Real least = 1e300L;
  for (const auto& s : facesOf(std::get<Box>(a), X_WA))
    for (const auto& t : facesOf(std::get<Box>(b), X_WB)) least = std::min(least, test::triangleDistance(s, t));
  return least;
}

Real distanceOf(const Solid& a, const Isometry3d& X_WA, const Solid& b, const Isometry3d& X_WB) {
  Real least = 1e300L;
  for (const Primitive& of_a : a)
    for (const Primitive& of_b : b) least = std::min(least, distanceOf(of_a, X_WA, of_b, X_WB));
  return least;
}

double anySize(Random& random) {
  return std::pow(10.0, uniform(random, -3.0, 1.0));
}

/// A solid whose distance from `other` has a closed form.
Solid anySolid(Random& random, const Solid& other) {
  const double size = anySize(random);
  const auto flat = [&] { return size * std::pow(10.0, uniform(random, -2.0, 0.0)); };
  const bool is_with_cylinder = !other.empty() && std::holds_alternative<Cylinder>(other[0]);
  switch (random() % (other.empty() ? 4 : is_with_cylinder ? 2 : 4)) {
    case 0:
      return {Sphere{size}};
    case 1:
      if (other.empty()) return {Cylinder::fromRadiusAndLength(flat(), size)};
      return {HalfSpace{test::direction(random), uniform(random, -1.0, 1.0)}};
    case 2:
      return {Box::fromSize({size, flat(), flat()})};
    default:
      return {Box::fromSize({size, flat(), flat()}), Sphere{0.4 * size}};
  }
}

BodyDescription described(const std::string& name, const Solid& solid) {
  BodyDescription body = test::body(name, solid[0], name == "b");
  for (std::size_t i = 1; i < solid.size(); ++i)
    body.geometry.push_back({solid[i], Isometry3d::Identity(), "part", false});
  return body;
}

double sizeOf(const Solid& solid) {
  double size = 0.0;
  for (const Primitive& part : solid)
    if (!isHalfSpace(part)) size = std::max(size, boundingBox(part).sizes().norm());
  return size;
}

class Climb {
 public:
  explicit Climb(Random& random)
      : random_(random),
        a_(anySolid(random, {})),
        b_(anySolid(random, a_)),
        scale_(std::max(sizeOf(a_), sizeOf(b_))),
        scene_(test::build({described("a", a_), described("b", b_)}, coarse())),
        monitor_(scene_, test::soft()),
        distances_(scene_) {}

  void run(int steps) {
    X_A_ = test::pose(random_, 3.0, 2.0);
    X_B_ = placed(test::pose(random_, 3.0, 2.0));
    double best = -1e300;
    for (int i = 0; i < steps; ++i) {
      const double size = scale_ * std::pow(10.0, uniform(random_, -8.0, 0.0));
      const Isometry3d A = X_A_, B = X_B_;
      const Isometry3d A1 = A * test::pose(random_, std::min(3.0, size / scale_), size);
      Isometry3d B1 = B * test::pose(random_, std::min(3.0, size / scale_), size);
      if (random_() % 4 == 0) B1 = placed(B1);
      if (random_() % 8 == 0) B1 = B;
      const double wrong = cycle(A, A1, B, B1);
      if (wrong >= best || random_() % 10 == 0) {
        best = wrong;
        X_A_ = A1;
        X_B_ = B1;
      }
      if (::testing::Test::HasFailure()) return;
    }
  }

  int near = 0, with_slab = 0;

 private:
  static BodyOptions coarse() {
    BodyOptions options;
    options.points_across = options.cells_across = 6.0;
    return options;
  }

  /// Moved along a line through the bodies until the gap is as drawn.
  Isometry3d placed(const Isometry3d& X) {
    const double wanted = random_() % 5 == 0 ? 0.0 : scale_ * std::pow(10.0, uniform(random_, -7.0, 0.0));
    Vector3d way = test::direction(random_);
    if (const auto* plane = std::get_if<HalfSpace>(&b_[0])) way = -(X.linear() * plane->normal);
    const auto moved = [&](double by) {
      return Isometry3d(Eigen::Translation3d(X_A_.translation() - X.translation() + by * way)) * X;
    };
    double low = -4.0 * scale_ - 2.0, high = 4.0 * scale_ + 4.0;
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      (distanceOf(a_, X_A_, b_, moved(middle)) < Real(wanted) ? low : high) = middle;
    }
    return moved(random_() % 2 == 0 ? high : low);
  }

  /// Runs a cycle and judges what is said of its end. @return how near it is to being wrong [share of the scale].
  double cycle(const Isometry3d& A0, const Isometry3d& A1, const Isometry3d& B0, const Isometry3d& B1) {
    constexpr double kLength = 0.1;
    const double range = 0.5 * scale_, tiny = 1e-9 * (1.0 + scale_);
    const CycleMotion motion = test::cycle(kLength, {{A0, A1}, {B0, B1}});
    const CycleResult& result = monitor_.run(motion, {});
    const std::vector<PairDistance>& found = distances_.update(motion, result, range, {});
    const Verdict verdict = result.pairs[0].verdict;
    const auto exact = static_cast<double>(distanceOf(a_, A1, b_, B1));
    const auto before = static_cast<double>(distanceOf(a_, A0, b_, B0));
    const std::string what = std::to_string(a_[0].index()) + (a_.size() > 1 ? "+" : "") + " " +
                             std::to_string(b_[0].index()) + (b_.size() > 1 ? "+" : "") + " " + toString(verdict) +
                             ", scale " + std::to_string(scale_) + ", truth " + std::to_string(exact);
    if (verdict == Verdict::kClear) {
      EXPECT_GT(std::min(exact, before), 0.0) << what;
    }
    if (verdict == Verdict::kNotChecked) return -1.0;
    if (found.empty()) {
      EXPECT_GT(exact, range - tiny) << what;
      return -1.0;
    }
    ++near;
    const PairDistance& pair = found[0];
    const double off = std::abs(pair.distance - exact) - pair.error, wide = pair.any.width - exact;
    EXPECT_LE(off, tiny) << what << ", said " << pair.distance << " ± " << pair.error;
    EXPECT_LE(wide, tiny) << what;
    EXPECT_GE(pair.any.closing * pair.any.over, before - exact - tiny) << what;
    double worst = std::max(off, wide);
    const bool a_is_first = pair.body_a == 0;
    const Solid &first = a_is_first ? a_ : b_, &second = a_is_first ? b_ : a_;
    const Pose F0(a_is_first ? A0 : B0), F1(a_is_first ? A1 : B1), S0(a_is_first ? B0 : A0), S1(a_is_first ? B1 : A1);
    if (verdict == Verdict::kClear && pair.distance > 0.0) {
      const Real on_a = signedDistance(first, F1, pair.p_A_W.cast<Real>()),
                 on_b = signedDistance(second, S1, pair.p_B_W.cast<Real>());
      EXPECT_LE(std::abs(static_cast<double>(on_a)), pair.error + tiny) << what;
      EXPECT_LE(std::abs(static_cast<double>(on_b)), pair.error + tiny) << what;
      EXPECT_NEAR((pair.p_B_W - pair.p_A_W).norm(), pair.distance, pair.error + tiny) << what;
      EXPECT_LT((pair.p_B_W - pair.p_A_W - pair.distance * pair.normal_W).norm(), pair.error + tiny) << what;
    }
    if (!pair.slab) return worst / scale_;
    ++with_slab;
    // The slab's direction is fixed to the first body, unless the second one has the plane.
    const Vector3r n1 = pair.normal_W.cast<Real>();
    const bool is_fixed_to_first = !isHalfSpace(second[0]);
    const Vector3r n0 =
        is_fixed_to_first ? Vector3r(F0.R * F1.R.transpose() * n1) : Vector3r(S0.R * S1.R.transpose() * n1);
    const auto gap = [&](const Pose& F, const Pose& S, const Vector3r& n) {
      return static_cast<double>(-support(second, S, -n) - support(first, F, n));
    };
    const double gap_now = gap(F1, S1, n1), gap_then = gap(F0, S0, n0);
    EXPECT_LE(pair.slab->width, std::max(0.0, gap_now) + tiny) << what;
    EXPECT_GE(pair.slab->closing * pair.slab->over, gap_then - gap_now - tiny) << what;
    return std::max(worst, pair.slab->width - std::max(0.0, gap_now)) / scale_;
  }

  Random& random_;
  const Solid a_, b_;
  const double scale_;
  std::shared_ptr<const Scene> scene_;
  Monitor monitor_;
  PairDistances distances_;
  Isometry3d X_A_ = Isometry3d::Identity(), X_B_ = Isometry3d::Identity();
};

TEST(ExactDistances, NoClimbFindsOneThatIsWrong) {
  Random random(77);
  int near = 0, with_slab = 0;
  for (int i = 0; i < 12; ++i) {
    Climb climb(random);
    for (int k = 0; k < 3; ++k) climb.run(60);
    near += climb.near;
    with_slab += climb.with_slab;
    ASSERT_FALSE(HasFailure()) << "solids " << i;
  }
  EXPECT_GT(near, 500);
  EXPECT_GT(with_slab, 150);
}

}  // namespace sdf_ccd::exact_distances_test
