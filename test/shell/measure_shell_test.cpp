#include "shell/measure_shell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "oracle/shapes.h"

namespace sdf_ccd::measure_shell_test {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;
using Polygon = std::vector<Point>;

/// The part of a convex polygon that is nearer to p than to q.
Polygon nearer(const Polygon& polygon, const Point& p, const Point& q) {
  const Point normal = q - p, middle = (p + q) / 2;
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Real side_a = (a - middle).dot(normal), side_b = (b - middle).dot(normal);
    if (side_a <= 0) kept.push_back(a);
    if (side_a * side_b < 0) kept.push_back(a + (b - a) * (side_a / (side_a - side_b)));
  }
  return kept;
}

Real areaOf(const Polygon& polygon) {
  Point sum = Point::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum.norm() / 2;
}

struct Measured {
  double radius = 0.0;
  std::vector<double> areas;
};

/// By brute force: each triangle is cut by the bisecting planes of all pairs of points.
Measured measureEachByEach(const TriangleMesh& mesh, const SampledPoints& shell) {
  Measured measured;
  measured.areas.assign(shell.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Polygon whole;
    for (int k = 0; k < 3; ++k) whole.push_back(mesh.vertices[mesh.triangles[t][k]].cast<Real>());
    const Vector3d facing = areaNormal(mesh, static_cast<int>(t));
    std::vector<char> takes(shell.size());
    for (std::size_t i = 0; i < shell.size(); ++i) takes[i] = shell.normals[i].cast<double>().dot(facing) >= 0;
    const bool any = std::count(takes.begin(), takes.end(), 1) == 0;
    for (std::size_t i = 0; i < shell.size(); ++i) {
      Polygon cell = whole, own = any || takes[i] ? whole : Polygon();
      for (std::size_t j = 0; j < shell.size(); ++j) {
        if (j == i) continue;
        const Point p = shell.points[i].cast<Real>(), q = shell.points[j].cast<Real>();
        if (p == q) {  // the first of several points at one location gets all of the area
          if (j < i) cell.clear();
          if (j < i && (any || takes[j])) own.clear();
          continue;
        }
        cell = nearer(cell, p, q);
        if (any || takes[j]) own = nearer(own, p, q);
      }
      for (const Point& corner : cell)
        measured.radius =
            std::max(measured.radius, static_cast<double>((corner - shell.points[i].cast<Real>()).norm()));
      measured.areas[i] += static_cast<double>(areaOf(own));
    }
  }
  return measured;
}

/// Random points of the mesh, each with its triangle's normal; some are duplicates, some are off the mesh.
SampledPoints drawnShell(const TriangleMesh& mesh, std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  std::vector<double> weights;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    weights.push_back(areaNormal(mesh, static_cast<int>(i)).norm());
  std::discrete_distribution<int> pick(weights.begin(), weights.end());
  SampledPoints shell;
  while (shell.size() < count) {
    const int triangle = pick(random);
    const Vector3i& t = mesh.triangles[triangle];
    const double u = std::sqrt(uniform(random)), v = uniform(random);
    Vector3d p = (1 - u) * mesh.vertices[t[0]] + u * (1 - v) * mesh.vertices[t[1]] + u * v * mesh.vertices[t[2]];
    if (uniform(random) < 0.1) p = mesh.vertices[t[0]];
    if (uniform(random) < 0.1) p += 0.02 * Vector3d(uniform(random), uniform(random), uniform(random));
    const int copies = uniform(random) < 0.1 ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      shell.points.push_back(p);
      shell.normals.push_back(((i == 0 ? 1.0 : -1.0) * areaNormal(mesh, triangle).normalized()).cast<float>());
    }
  }
  return shell;
}

TEST(MeasureShell, IsAsEachPointAgainstEachSays) {
  TriangleMesh needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}, {0.3, 1e-4, 0}};
  needle.triangles = {{0, 1, 2}};
  const std::vector<TriangleMesh> meshes = {test::boxMesh({0.5, 0.3, 0.2}),
                                            test::boxMesh({0.5, 0.5, 0.0005}),
                                            test::icosphere(0.5, 1),
                                            test::torusMesh(0.4, 0.1, 12, 6),
                                            needle,
                                            test::translated(test::boxMesh({0.5, 0.3, 0.2}), {100.0, -50.0, 3.0})};
  std::mt19937_64 random(7);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const TriangleMesh& mesh = meshes[m];
    const double area = surfaceArea(mesh);
    for (const std::size_t count : {1, 2, 5, 20, 70}) {
      const SampledPoints shell = drawnShell(mesh, count, random);
      const Measured expected = measureEachByEach(mesh, shell);
      for (const double scale : {0.5, 0.1, 0.02}) {
        const auto [areas, radius] = measureShell(mesh, shell, scale);
        EXPECT_GE(radius, expected.radius) << m << " " << count << " " << scale;
        EXPECT_LE(radius, expected.radius * (1 + 2e-9) + 1e-9 * scale + 1e-11) << m << " " << count << " " << scale;
        ASSERT_EQ(areas.size(), shell.size());
        double off = std::abs(std::accumulate(areas.begin(), areas.end(), -area));
        for (std::size_t i = 0; i < areas.size(); ++i) off = std::max(off, std::abs(areas[i] - expected.areas[i]));
        EXPECT_LE(off, 1e-9 * area) << m << " " << count << " " << scale;
      }
    }
  }
}

/// The poles of a sphere as scripts write them: sin(π) is 1e-16, so the vertices there differ by rounding only.
TEST(MeasureShell, PointsThatCoincideToRoundingTakeNoTime) {
  constexpr int kSides = 200;
  TriangleMesh mesh = test::boxMesh({0.1, 0.1, 0.1});
  SampledPoints shell;
  const auto add = [&](const Vector3d& p) {
    shell.points.push_back(p);
    shell.normals.push_back(-p.normalized().cast<float>());
    shell.areas.push_back(1.0F);
  };
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * M_PI * i / kSides;
    add({1e-17 * std::cos(angle), 1e-17 * std::sin(angle), 0.1});
  }
  for (const Vector3d& corner : mesh.vertices) add(corner);
  const auto [areas, radius] = measureShell(mesh, shell, 0.05);
  EXPECT_GT(radius, 0.1);
  EXPECT_LT(radius, 0.15);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 6 * 0.04, 1e-9);
}

}  // namespace sdf_ccd::measure_shell_test
