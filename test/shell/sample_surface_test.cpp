#include "shell/sample_surface.h"

#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "common/processor_time.h"
#include "mesh/triangle_tree.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "sdf_ccd/mesh.h"
#include "shell/point_shell.h"

namespace sdf_ccd::sample_surface_test {

constexpr double kRounding = 1e-6;  // relative, of normals and areas

double sum(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Random points on the mesh, uniform by area.
std::vector<Vector3d> randomPlaces(const TriangleMesh& mesh, int count) {
  std::mt19937_64 random(42);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> weights;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) weights.push_back(areaNormal(mesh, i).norm());
  std::discrete_distribution<int> pick(weights.begin(), weights.end());
  std::vector<Vector3d> places;
  for (int i = 0; i < count; ++i) {
    const Vector3i& t = mesh.triangles[pick(random)];
    const double u = std::sqrt(uniform(random)), v = uniform(random);
    places.push_back((1 - u) * mesh.vertices[t[0]] + u * (1 - v) * mesh.vertices[t[1]] + u * v * mesh.vertices[t[2]]);
  }
  return places;
}

double nearestDistance(const PointShell& shell, const Vector3d& place) {
  double best = 1e300;
  for (const Vector3d& p : shell.points()) best = std::min(best, (p - place).norm());
  return best;
}

std::vector<std::pair<const char*, TriangleMesh>> meshes() {
  TriangleMesh needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}, {0.3, 1e-4, 0}};
  needle.triangles = {{0, 1, 2}};
  return {{"box", test::boxMesh({0.5, 0.3, 0.2})},
          {"plate", test::boxMesh({0.5, 0.5, 0.0005})},
          {"sphere", test::icosphere(0.5, 3)},
          {"torus", test::torusMesh(0.4, 0.1, 40, 16)},
          {"needle", needle}};
}

/// A folded sheet of four triangles, much longer than wide.
TriangleMesh sliver(double length) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {length, 0, 0}, {length, 1e-4, 0}, {0, 1e-4, 1e-4}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  return mesh;
}

TEST(SampleSurface, CoveringRadiusIsABoundFromBothSides) {
  for (const auto& [name, mesh] : meshes()) {
    for (const double spacing : {0.2, 0.05}) {
      ShellOptions options;
      options.spacing = spacing;
      const PointShell shell = sampleSurface(mesh, options);
      EXPECT_LE(shell.covering_radius, spacing + shell.position_error) << name;
      double sampled = 0;
      for (const Vector3d& place : randomPlaces(mesh, 20000)) {
        sampled = std::max(sampled, nearestDistance(shell, place));
      }
      EXPECT_LE(sampled, shell.covering_radius) << name;
      EXPECT_GE(sampled, 0.9 * shell.covering_radius) << name << " " << spacing;
    }
  }
}

TEST(SampleSurface, CoveringRadiusOfASquareIsExact) {
  // A square whose corners are the only points: its middle is the farthest location.
  TriangleMesh square;
  square.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  ShellOptions options;
  options.spacing = 0.75;
  const PointShell shell = sampleSurface(square, options);
  ASSERT_EQ(shell.size(), 4u);
  EXPECT_NEAR(shell.covering_radius, std::sqrt(0.5), 1e-8);
  for (const double area : shell.areas) EXPECT_NEAR(area, 0.25, 1e-12);
}

TEST(SampleSurface, AreasSumToTheMeshAndGoToTheNearest) {
  for (const auto& [name, mesh] : meshes()) {
    ShellOptions options;
    options.spacing = 0.1;
    const PointShell shell = sampleSurface(mesh, options);
    EXPECT_NEAR(sum(shell.areas), surfaceArea(mesh), kRounding * surfaceArea(mesh)) << name;
    for (const double area : shell.areas) EXPECT_GE(area, 0);
  }
}

TEST(SampleSurface, AreasAgreeWithCountingRandomPlaces) {
  const TriangleMesh mesh = test::boxMesh({0.5, 0.4, 0.3});
  ShellOptions options;
  options.spacing = 0.3;
  const PointShell shell = sampleSurface(mesh, options);
  std::vector<double> counted(shell.size(), 0.0);
  const std::vector<Vector3d> places = randomPlaces(mesh, 200000);
  for (const Vector3d& place : places) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < shell.size(); ++i) {
      if ((shell.point(i) - place).norm() < (shell.point(nearest) - place).norm()) nearest = i;
    }
    counted[nearest] += surfaceArea(mesh) / places.size();
  }
  // The box is so thick that no point is nearest to the opposite side, except around edges.
  double moved = 0;
  for (std::size_t i = 0; i < shell.size(); ++i) moved += std::abs(shell.areas[i] - counted[i]) / 2;
  EXPECT_LT(moved, 0.06 * surfaceArea(mesh));
}

TEST(SampleSurface, AThinPlateHasPointsAndAreaOnBothSides) {
  ShellOptions options;
  options.spacing = 0.05;
  const PointShell shell = sampleSurface(test::boxMesh({0.5, 0.5, 0.0005}), options);
  double up = 0, down = 0;
  for (std::size_t i = 0; i < shell.size(); ++i) (shell.normal(i).z() > 0 ? up : down) += shell.areas[i];
  EXPECT_NEAR(up, down, 0.02);
  std::size_t above = 0;
  for (const PackedNormal& normal : shell.normals) above += normal.vector().z() > 0.9;
  EXPECT_NEAR(static_cast<double>(above) / shell.size(), 0.5, 0.05);
}

TEST(SampleSurface, PointsKeepTheirDistanceAndLieOnTheMesh) {
  const TriangleMesh mesh = test::icosphere(0.5, 2);
  ShellOptions options;
  options.spacing = 0.04;
  const PointShell shell = sampleSurface(mesh, options);
  const TriangleTree tree(mesh);
  const std::size_t vertices = mesh.vertices.size();
  for (std::size_t i = 0; i < shell.size(); ++i) {
    EXPECT_LT(tree.closestPoint(shell.point(i)).distance, shell.position_error + 1e-14);
    EXPECT_GT(shell.normal(i).dot(shell.point(i).normalized()), 0.9);
    for (std::size_t j = vertices; j < i; ++j) {
      EXPECT_GT((shell.point(i) - shell.point(j)).norm(), 0.94 * options.spacing);
    }
  }
}

TEST(SampleSurface, VerticesAreKeptOrThinned) {
  const TriangleMesh mesh = test::icosphere(0.5, 4);
  ShellOptions options;
  options.spacing = 0.2;
  const PointShell all = sampleSurface(mesh, options);
  ASSERT_GE(all.size(), mesh.vertices.size());
  options.vertex_spacing = 0.1;
  const PointShell thinned = sampleSurface(mesh, options);
  EXPECT_LT(thinned.size(), all.size() / 4);
  EXPECT_LE(thinned.covering_radius, 0.2 + thinned.position_error);
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((thinned.point(i) - thinned.point(j)).norm(), 0.1 - 2.0 * thinned.position_error);
  }
}

TEST(SampleSurface, EqualSeedsGiveEqualShells) {
  ShellOptions options;
  options.spacing = 0.05;
  const TriangleMesh mesh = test::torusMesh(0.4, 0.1, 20, 10);
  const PointShell a = sampleSurface(mesh, options), b = sampleSurface(mesh, options);
  EXPECT_EQ(a.points(), b.points());
  EXPECT_EQ(a.areas, b.areas);
  EXPECT_EQ(a.covering_radius, b.covering_radius);
  options.seed = 2;
  EXPECT_NE(sampleSurface(mesh, options).points(), a.points());
}

TEST(SampleSurface, PrimitivesArePointsOfTheirSurface) {
  const std::vector<std::pair<Primitive, double>> solids = {
      {Sphere{0.3}, 4 * test::kPi * 0.09},
      {Box::fromSize({0.2, 0.4, 0.6}), 8 * (0.02 + 0.06 + 0.03)},
      {Cylinder::fromRadiusAndLength(0.1, 0.4), 2 * test::kPi * 0.1 * 0.5}};
  for (const auto& [solid, area] : solids) {
    for (const double spacing : {0.05, 0.02}) {
      ShellOptions options;
      options.spacing = spacing;
      const PointShell shell = sampleSurface(solid, options);
      EXPECT_LE(shell.covering_radius, spacing + shell.position_error);
      EXPECT_NEAR(sum(shell.areas), area, kRounding * area);
      for (std::size_t i = 0; i < shell.size(); ++i) {
        EXPECT_NEAR(signedDistance(solid, shell.point(i)), 0, shell.position_error + 1e-15);
        EXPECT_GT(signedDistance(solid, shell.point(i) + 1e-6 * shell.normal(i)), 5e-7);
      }
      double sampled = 0;
      for (const Vector3d& near : randomPlaces(tessellate(solid, 1e-6), 5000)) {
        const Vector3d place = near - signedDistance(solid, near) * distanceGradient(solid, near);
        sampled = std::max(sampled, nearestDistance(shell, place));
      }
      EXPECT_LE(sampled, shell.covering_radius);
      EXPECT_GE(sampled, 0.85 * shell.covering_radius);
    }
  }
}

TEST(SampleSurface, NormalsOfACylinderAreThoseOfItsSides) {
  ShellOptions options;
  options.spacing = 0.02;
  const PointShell shell = sampleSurface(Primitive(Cylinder::fromRadiusAndLength(0.1, 0.4)), options);
  for (std::size_t i = 0; i < shell.size(); ++i) {
    const Vector3d p = shell.point(i);
    const double rounding = shell.position_error + 1e-12;
    const bool on_cap = std::abs(std::abs(p.z()) - 0.2) < rounding,
               on_side = std::abs(p.head<2>().norm() - 0.1) < rounding;
    ASSERT_TRUE(on_cap || on_side);
    if (on_cap && on_side) continue;
    const Vector3d expected = on_cap ? Vector3d(0, 0, p.z() > 0 ? 1 : -1) : Vector3d(p.x() / 0.1, p.y() / 0.1, 0);
    // The normal is that of the point before it was rounded.
    EXPECT_LT((shell.normal(i) - expected).norm(), PackedNormal::kMaxError + kRounding) << p.transpose();
  }
}

TEST(SampleSurface, BadInputIsRefused) {
  const TriangleMesh mesh = test::boxMesh({1, 1, 1});
  ShellOptions options;
  for (const double spacing : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    options.spacing = spacing;
    EXPECT_THROW(sampleSurface(mesh, options), std::invalid_argument);
  }
  options = {};
  options.vertex_spacing = -1;
  EXPECT_THROW(sampleSurface(mesh, options), std::invalid_argument);
  for (const double gap : {-1.0, std::nan(""), HUGE_VAL}) {
    options = {};
    options.edge_gap = gap;
    EXPECT_THROW(sampleSurface(mesh, options), std::invalid_argument);
  }
  options = {};
  EXPECT_THROW(sampleSurface(TriangleMesh{}, options), std::invalid_argument);
  EXPECT_THROW(sampleSurface(Primitive(HalfSpace{{0, 0, 1}, 0}), options), std::invalid_argument);
  options.spacing = 1e-7;
  EXPECT_THROW(sampleSurface(mesh, options), std::length_error);
  options.spacing = 0.05;
  options.max_points = 100;
  EXPECT_THROW(sampleSurface(mesh, options), std::length_error);
}

TEST(SampleSurface, WhatWouldTakeTooManyPointsIsRefusedBeforeItIsSampled) {
  const TriangleMesh plate = test::boxMesh({1.0, 1.0, 0.005});
  ShellOptions options;
  options.spacing = 0.006;
  double start = threadSeconds();
  const std::size_t points = sampleSurface(plate, options).size();
  const double sampled = threadSeconds() - start;
  // A limit that no sampling could keep, and one not much below the number of points that darts take.
  for (const double share : {0.2, 0.8}) {
    options.max_points = static_cast<std::size_t>(share * static_cast<double>(points));
    start = threadSeconds();
    EXPECT_THROW(sampleSurface(plate, options), std::length_error);
    EXPECT_LT(threadSeconds() - start, 0.05 * sampled) << share;
  }
}

TEST(SampleSurface, SliversTakeTimeByTheirLength) {
  ShellOptions options;
  options.spacing = 1e-3;
  const auto seconds = [&](double length) {
    const double start = threadSeconds();
    const PointShell shell = sampleSurface(sliver(length), options);
    EXPECT_LE(shell.covering_radius, options.spacing + shell.position_error);
    EXPECT_NEAR(sum(shell.areas), surfaceArea(sliver(length)), kRounding * surfaceArea(sliver(length)));
    return threadSeconds() - start;
  };
  EXPECT_LT(seconds(8.0), 4 * 32 * seconds(0.25));
}

TEST(SampleSurface, SliversThatNeedTooManyPointsAreRefusedBeforehand) {
  ShellOptions options;
  options.spacing = 1e-3;
  options.max_points = 100'000;
  EXPECT_NO_THROW(sampleSurface(sliver(10.0), options));
  const double start = threadSeconds();
  EXPECT_THROW(sampleSurface(sliver(1e6), options), std::length_error);
  // A fan: few points cover all of it, but its triangles have many slices.
  TriangleMesh fan;
  fan.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i <= 10'000; ++i) fan.vertices.emplace_back(1, 1e-6 * i, 0);
  for (int i = 1; i <= 10'000; ++i) fan.triangles.emplace_back(0, i, i + 1);
  EXPECT_THROW(sampleSurface(fan, options), std::length_error);
  EXPECT_LT(threadSeconds() - start, 1.0);
}

TEST(SampleSurface, DegenerateTrianglesDoNoHarm) {
  TriangleMesh mesh = test::boxMesh({0.5, 0.5, 0.5});
  mesh.vertices.emplace_back(0.5, 0.0, 0.5);
  mesh.triangles.emplace_back(5, 8, 7);  // on an edge, without area
  ShellOptions options;
  options.spacing = 0.1;
  const PointShell shell = sampleSurface(mesh, options);
  EXPECT_NEAR(sum(shell.areas), 6, 6 * kRounding);
}

TEST(SampleSurface, WhatIsRefusedBeforehandIsAboutRight) {
  std::vector<std::pair<const char*, TriangleMesh>> closed = meshes();
  closed.emplace_back("sliver", sliver(10.0));
  closed.emplace_back("rod", test::boxMesh({5.0, 1e-4, 1e-4}));
  for (const auto& [name, mesh] : closed) {
    if (mesh.triangles.size() == 1) continue;
    for (const double gap : {0.0, 0.004}) {
      ShellOptions options;
      options.spacing = 0.03;
      options.vertex_spacing = 0.03;
      options.edge_gap = gap;
      const auto made = static_cast<double>(sampleSurface(mesh, options).size());
      options.max_points = static_cast<std::size_t>(1.6 * made);
      EXPECT_NO_THROW(sampleSurface(mesh, options)) << name << " " << gap;
      options.max_points = static_cast<std::size_t>(made / 1.6);
      EXPECT_THROW(sampleSurface(mesh, options), std::length_error) << name << " " << gap;
    }
  }
}

TEST(SampleSurface, RobotMeshes) {
  for (const char* name :
       {"robots/panda_description/meshes/collision/link5.stl", "meshes/teapot.obj", "meshes/cgal_nasty/boeing.off"}) {
    SDF_CCD_NEEDS_DATA(name);
    const TriangleMesh mesh = loadMesh(test::dataPath(name));
    ShellOptions options;
    options.spacing = boundingBox(mesh).sizes().maxCoeff() / 50;
    const PointShell shell = sampleSurface(mesh, options);
    EXPECT_LE(shell.covering_radius, options.spacing + shell.position_error);
    EXPECT_NEAR(sum(shell.areas), surfaceArea(mesh), kRounding * surfaceArea(mesh));
    for (const Vector3d& place : randomPlaces(mesh, 500)) {
      EXPECT_LE(nearestDistance(shell, place), shell.covering_radius);
    }
  }
}

TEST(SampleSurface, FacesInsideTheSolidGetNoPointsAndNoArea) {
  // Two boxes that overlap by half, 1.5 × 0.6 × 0.6 m together; equally wide, or one a little wider.
  for (const double half_width : {0.3, 0.31}) {
    const Vector3d half_size(0.5, half_width, half_width), half_size_of_first(0.5, 0.3, 0.3), shift(0.25, 0, 0);
    const TriangleMesh mesh = merged(test::translated(test::boxMesh(half_size_of_first), -shift),
                                     test::translated(test::boxMesh(half_size), shift));
    ShellOptions options;
    options.spacing = 0.05;
    const PointShell shell = sampleSurface(mesh, options);
    double area = 0;
    for (std::size_t i = 0; i < shell.size(); ++i) {
      const Vector3d p = shell.point(i);
      EXPECT_GE(((p + shift).cwiseAbs() - half_size_of_first).maxCoeff(), -1e-9 - shell.position_error)
          << p.transpose();
      EXPECT_GE(((p - shift).cwiseAbs() - half_size).maxCoeff(), -1e-9 - shell.position_error) << p.transpose();
      area += shell.areas[i];
    }
    EXPECT_NEAR(area, 0.5 * 2.4 + 8 * half_width + 8 * half_width * half_width, 1e-9);
    EXPECT_LE(shell.covering_radius, options.spacing + shell.position_error);
  }
}

TEST(SampleSurface, HeapsOfVerticesAlongSeamsAreThinned) {
  // Faces that cross at tiny angles: many vertices within a fraction of the spacing.
  TriangleMesh mesh = test::boxMesh({0.2, 0.15, 0.1});
  for (int i = 1; i < 12; ++i) {
    const Isometry3d X(Eigen::AngleAxisd(1e-7 * i, Vector3d(1, 2 + 0.1 * i, 3).normalized()));
    mesh = merged(mesh, transformed(test::boxMesh({0.2, 0.15, 0.1}), X));
  }
  ShellOptions options;
  options.spacing = 0.02;
  const PointShell shell = sampleSurface(mesh, options);
  EXPECT_LE(shell.covering_radius, options.spacing + shell.position_error);
  EXPECT_LT(shell.size(), 5000U);
}

}  // namespace sdf_ccd::sample_surface_test
