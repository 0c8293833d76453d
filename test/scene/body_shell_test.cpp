#include "scene/body_shell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "oracle/contact_case.h"
#include "oracle/random.h"
#include "shell/contact_gap.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::body_shell_test {

using namespace test;

constexpr double kGap = 0.002;

ShellOptions options() {
  ShellOptions options;
  options.spacing = 0.02;
  options.edge_gap = kGap;
  options.has_siblings = true;
  return options;
}

struct Element {
  Primitive shape;
  Isometry3d X_BG;
};

/// A body of several elements, with its shell and its exact distance.
struct Union {
  std::vector<Element> elements;
  PointShell shell;
  std::vector<Vector3d> places;  ///< on its surface, sampled independently of the shell

  explicit Union(const std::vector<Element>& all) : elements(all) {
    std::vector<DistanceField> fields;
    for (const Element& element : elements) fields.emplace_back(element.shape);
    std::vector<ShellPart> parts;
    ShellOptions other;
    other.spacing = 0.004;
    other.seed = 2;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      parts.push_back({elements[i].X_BG, sampleSurface(elements[i].shape, options()), &fields[i]});
      for (const Vector3d& p : sampleSurface(elements[i].shape, other).points()) {
        const Vector3d p_B = elements[i].X_BG * p;
        if (distance(p_B) > -1e-9) places.push_back(p_B);
      }
    }
    shell = unionShell(parts);
  }

  double distance(const Vector3d& p_B) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Element& element : elements)
      least = std::min(least, signedDistance(element.shape, element.X_BG.inverse() * p_B));
    return least;
  }
};

double nearest(const Union& shell, const Isometry3d& X_FP, const Union& field) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : shell.shell.points()) least = std::min(least, field.distance(X_FP * p));
  return least;
}

/// Elements with sharp edges, with round edges, and a bead whose points cover all of it, joined.
Union tool() {
  return Union({{Box::fromSize({0.08, 0.04, 0.02}), Isometry3d::Identity()},
                {Cylinder::fromRadiusAndLength(0.008, 0.1), pose({0.07, 0, 0}, 1.5707963, {0, 1, 0})},
                {Sphere{0.008}, translation({0.12, 0, 0})}});
}

TEST(UnionShell, KeepsTheGapOfItsElements) {
  const Union whole = tool();
  const PointShell bead = sampleSurface(Primitive(Sphere{0.008}), options());
  ASSERT_EQ(bead.edge_radius, std::numeric_limits<double>::infinity()) << "the bead is not covered all over";
  const PointShell plate = sampleSurface(Primitive(Box::fromSize({0.4, 0.4, 0.02})), options());
  const double largest = kGap * (1 + 1e-9) + std::max(whole.shell.position_error, plate.position_error);
  EXPECT_LE(contactGap(whole.shell, whole.shell), largest);
  EXPECT_LE(contactGap(whole.shell, plate), largest);
  EXPECT_LE(contactGapToPlane(whole.shell), largest);
  EXPECT_GT(whole.shell.covering_radius, 5.0 * kGap);  // faces keep their few points
}

TEST(UnionShell, GapHoldsWhereverUnionsMeet) {
  const Union a = tool();
  // Two crossing plates meet in concave seams, which are edges of neither.
  const Union b({{Box::fromSize({0.1, 0.1, 0.008}), Isometry3d::Identity()},
                 {Box::fromSize({0.1, 0.1, 0.008}), pose({0, 0, 0.01}, 1.2, {1, 0, 0})}});
  Random random(5);
  double largest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Union& other = i % 2 ? a : b;
    const Vector3d x_A = a.places[random() % a.places.size()], x_B = other.places[random() % other.places.size()];
    Isometry3d X_AB = test::pose(random, 3.0, 0.0);
    X_AB.translation() = x_A - X_AB.linear() * x_B;
    largest = std::max(largest, std::min(nearest(other, X_AB, a), nearest(a, X_AB.inverse(), other)));
    ASSERT_LE(largest, contactGap(a.shell, other.shell)) << i;
  }
}

}  // namespace sdf_ccd::body_shell_test
