#include "mesh/generated_mesh.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "common/pi.h"
#include "common/refuse.h"
#include "polygon.h"

namespace sdf_ccd {
namespace {

using Ring = std::vector<Vector3d>;

void requireSizes(const std::string& shape, std::initializer_list<double> sizes) {
  for (const double size : sizes) requirePositive(shape + ": sizes", size, " m");
}

void requireSteps(const std::string& shape, int steps) {
  if (steps < 3) refuse(shape + ": at least 3 steps are needed, not " + std::to_string(steps));
}

Ring circle(double radius, double z, int steps) {
  Ring ring;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2.0 * kPi * i / steps;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return ring;
}

/// Surface of revolution about z of a profile (r, z) that runs from axis to axis.
TriangleMesh revolved(const std::vector<std::pair<double, double>>& profile, int steps) {
  std::vector<Ring> rings;
  for (const auto& [r, z] : profile) rings.push_back(r > 0.0 ? circle(r, z, steps) : Ring{Vector3d(0, 0, z)});
  return lofted(rings);
}

Ring threadRing(const Thread& thread, double widened, double z, int steps) {
  Ring ring = circle(1.0, z, steps);
  for (int i = 0; i < steps; ++i) {
    const double phase = 2.0 * kPi * (z / thread.pitch - double(i) / steps);
    ring[i].head<2>() *= thread.radius + widened - 0.5 * thread.depth * (1.0 - std::cos(phase));
  }
  return ring;
}

/// Rings along a thread's length, as far apart as the points of a ring.
std::vector<Ring> threadRings(const Thread& thread, double widened, double length, int steps) {
  const int rows = std::max(2, int(std::ceil(length / (2.0 * kPi * thread.radius / steps))));
  std::vector<Ring> rings;
  for (int k = 0; k <= rows; ++k) {
    rings.push_back(threadRing(thread, widened, length * (double(k) / rows - 0.5), steps));
  }
  return rings;
}

/// A regular hexagon of inner radius `across`, with as many points as a circle of the same steps.
Ring hexagon(double across, double z, int steps) {
  Ring ring = circle(1.0, z, steps);
  for (int i = 0; i < steps; ++i) {
    const double from_flat = std::remainder(2.0 * kPi * i / steps, kPi / 3.0);
    ring[i].head<2>() *= across / std::cos(from_flat);
  }
  return ring;
}

TriangleMesh outward(TriangleMesh mesh) {
  if (signedVolume(mesh) < 0.0) {
    for (Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

}  // namespace

TriangleMesh lofted(const std::vector<std::vector<Vector3d>>& rings, bool loop) {
  TriangleMesh mesh;
  std::vector<int> starts;
  for (const Ring& ring : rings) {
    starts.push_back(int(mesh.vertices.size()));
    mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  }
  const auto join = [&](std::size_t a, std::size_t b) {
    const int n = int(std::max(rings[a].size(), rings[b].size()));
    const auto vertex = [&](std::size_t ring, int i) { return starts[ring] + (rings[ring].size() == 1 ? 0 : i % n); };
    for (int i = 0; i < n; ++i) {
      if (rings[b].size() > 1) mesh.triangles.emplace_back(vertex(a, i), vertex(b, i), vertex(b, i + 1));
      if (rings[a].size() > 1) mesh.triangles.emplace_back(vertex(a, i), vertex(b, i + 1), vertex(a, i + 1));
    }
  };
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) join(k, k + 1);
  if (loop) {
    join(rings.size() - 1, 0);
    return outward(std::move(mesh));
  }
  const auto close = [&](std::size_t ring, bool first) {
    const int n = int(rings[ring].size());
    if (n == 1) return;
    const int middle = int(mesh.vertices.size());
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& p : rings[ring]) sum += p;
    mesh.vertices.push_back(sum / n);
    for (int i = 0; i < n; ++i) {
      const int a = starts[ring] + i, b = starts[ring] + (i + 1) % n;
      mesh.triangles.emplace_back(middle, first ? a : b, first ? b : a);
    }
  };
  close(0, true);
  close(rings.size() - 1, false);
  return outward(std::move(mesh));
}

TriangleMesh extruded(const std::vector<Vector3d>& outline, double height) {
  requireSizes("prism", {height});
  if (outline.size() < 3) refuse("prism: at least 3 corners are needed, not " + std::to_string(outline.size()));
  const int n = int(outline.size());
  TriangleMesh mesh;
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (const Vector3d& p : outline) mesh.vertices.emplace_back(p.x(), p.y(), z);
  }
  for (const Vector3i& t : triangulatePolygon(outline)) {
    mesh.triangles.emplace_back(t[0], t[2], t[1]);
    mesh.triangles.emplace_back(n + t[0], n + t[1], n + t[2]);
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.triangles.emplace_back(i, next, n + next);
    mesh.triangles.emplace_back(i, n + next, n + i);
  }
  return outward(std::move(mesh));
}

TriangleMesh bowlMesh(double radius, double thickness, int steps) {
  requireSizes("bowl", {radius, thickness, radius - thickness});
  requireSteps("bowl", steps);
  const int arc = std::max(2, steps / 4), rim = 6;
  std::vector<std::pair<double, double>> profile;
  for (int i = 0; i <= arc; ++i) {
    const double angle = 0.5 * kPi * i / arc;
    profile.emplace_back(i == 0 ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle));
  }
  for (int i = 1; i < rim; ++i) {
    const double angle = kPi * i / rim;
    profile.emplace_back(radius - 0.5 * thickness * (1.0 - std::cos(angle)), 0.5 * thickness * std::sin(angle));
  }
  for (int i = arc; i >= 0; --i) {
    const double angle = 0.5 * kPi * i / arc, inner = radius - thickness;
    profile.emplace_back(i == 0 ? 0.0 : inner * std::sin(angle), -inner * std::cos(angle));
  }
  return revolved(profile, steps);
}

TriangleMesh blobMesh(double radius, double bump, int points) {
  requireSizes("blob", {radius, bump, 0.6 - bump});
  const int rows = std::max(3, int(std::lround(std::sqrt(points / 2.0)))), steps = 2 * rows;
  std::vector<Ring> rings;
  for (int k = 0; k <= rows; ++k) {
    const double polar = kPi * k / rows;
    Ring ring =
        k == 0 || k == rows ? Ring{Vector3d(0, 0, std::cos(polar))} : circle(std::sin(polar), std::cos(polar), steps);
    for (Vector3d& p : ring) {
      const double wave = std::sin(4.0 * p.x() + 1.0) * std::sin(3.5 * p.y()) + std::cos(4.5 * p.z() + 2.0 * p.x());
      p *= radius * (1.0 + 0.5 * bump * wave);
    }
    rings.push_back(std::move(ring));
  }
  return lofted(rings);
}

TriangleMesh topMesh(double radius, double height, int steps) {
  requireSizes("top", {radius, height});
  requireSteps("top", steps);
  const double tip = 0.06 * radius, stem = 0.12 * radius, belly = 0.55 * height;
  std::vector<std::pair<double, double>> profile = {{0.0, 0.0}};
  for (int i = 1; i <= 4; ++i) {
    const double angle = 0.125 * kPi * i;
    profile.emplace_back(tip * std::sin(angle), tip * (1.0 - std::cos(angle)));
  }
  const int rows = 8;
  for (int i = 1; i <= rows; ++i) {
    profile.emplace_back(tip + (radius - tip) * i / rows, tip + (belly - tip) * i / rows);
  }
  profile.emplace_back(radius, belly + 0.1 * height);
  for (int i = 1; i <= 3; ++i) profile.emplace_back(radius + (stem - radius) * i / 3, belly + 0.1 * height);
  profile.emplace_back(stem, height);
  profile.emplace_back(0.0, height);
  return revolved(profile, steps);
}

TriangleMesh coneMesh(double radius, double height) {
  requireSizes("cone", {radius, height});
  constexpr int kSteps = 224;  // 1 / cos(π / 224) = 1 + 0.984e-4
  const double circumscribed = radius / std::cos(kPi / kSteps);
  return revolved({{0.0, -0.5 * height}, {circumscribed, -0.5 * height}, {0.0, 0.5 * height}}, kSteps);
}

TriangleMesh wedgeMesh(double width, double height, double length) {
  requireSizes("wedge", {width, height});
  const Isometry3d upright(Eigen::AngleAxisd(0.5 * kPi, Vector3d::UnitX()));
  return transformed(
      extruded({{-0.5 * width, 0.5 * height, 0}, {0, -0.5 * height, 0}, {0.5 * width, 0.5 * height, 0}}, length),
      upright);
}

TriangleMesh slotMesh(double width, double height, double length) {
  requireSizes("slot", {width, height});
  const double low = -height, high = 0.5 * height;
  const Isometry3d upright(Eigen::AngleAxisd(0.5 * kPi, Vector3d::UnitX()));
  return transformed(extruded({{-width, low, 0},
                               {width, low, 0},
                               {width, high, 0},
                               {0.5 * width, high, 0},
                               {0, -0.5 * height, 0},
                               {-0.5 * width, high, 0},
                               {-width, high, 0}},
                              length),
                     upright);
}

TriangleMesh boltMesh(const Thread& thread, double length, int steps) {
  requireSizes("bolt", {thread.radius, thread.pitch, thread.depth, thread.radius - thread.depth, length});
  requireSteps("bolt", steps);
  return lofted(threadRings(thread, 0.0, length, steps));
}

TriangleMesh nutMesh(const Thread& thread, double clearance, double height, int steps) {
  requireSizes("nut", {thread.radius, thread.pitch, thread.depth, thread.radius - thread.depth, clearance, height});
  requireSteps("nut", steps);
  std::vector<Ring> rings = threadRings(thread, clearance, height, steps);
  const double across = 1.8 * (thread.radius + clearance);
  rings.push_back(hexagon(across, 0.5 * height, steps));
  rings.push_back(hexagon(across, -0.5 * height, steps));
  return lofted(rings, true);
}

}  // namespace sdf_ccd
