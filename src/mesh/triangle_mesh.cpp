#include "sdf_ccd/mesh.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "mesh/box_measures.h"
#include "mesh/point_numbers.h"

namespace sdf_ccd {

void validate(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("the mesh has no triangle");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) {
      throw std::invalid_argument("vertex " + std::to_string(i) + " is not finite: " + vectorText(mesh.vertices[i]));
    }
  }
  const int count = static_cast<int>(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    if (t.minCoeff() < 0 || t.maxCoeff() >= count) {
      const int bad = t.minCoeff() < 0 ? t.minCoeff() : t.maxCoeff();
      throw std::invalid_argument("triangle " + std::to_string(i) + " refers to vertex " + std::to_string(bad) +
                                  ", but there are only " + std::to_string(count) + " vertices (from 0)");
    }
  }
  const AlignedBox3d box = boundingBox(mesh);
  const double extent = box.sizes().maxCoeff();
  const double reach = largestCoordinate(box);
  if (!(extent <= 1e6) || !(reach <= 1e9)) {
    throw std::invalid_argument("the mesh is too large or too far from the origin: extent " + numberText(extent) +
                                " m (limit 1e6), largest coordinate " + numberText(reach) + " m (limit 1e9)");
  }
  if (!(extent >= 1e-9)) throw std::invalid_argument("the mesh is smaller than 1e-9 m, at " + vectorText(box.min()));
}

AlignedBox3d boundingBox(const TriangleMesh& mesh) {
  AlignedBox3d box;
  for (const Vector3i& t : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) box.extend(mesh.vertices[t[corner]]);
  }
  return box;
}

Vector3d areaNormal(const TriangleMesh& mesh, int triangle) {
  const Vector3i& t = mesh.triangles[triangle];
  const Vector3d& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

double surfaceArea(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += areaNormal(mesh, static_cast<int>(i)).norm();
  return sum / 2;
}

double signedVolume(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  const Vector3d center = boundingBox(mesh).center();
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3d& a = mesh.vertices[mesh.triangles[i][0]];
    sum += (a - center).dot(areaNormal(mesh, static_cast<int>(i)));
  }
  return sum / 6;
}

TriangleMesh scaled(TriangleMesh mesh, const Vector3d& scale) {
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw std::invalid_argument("a mesh cannot be scaled by " + vectorText(scale));
  }
  for (Vector3d& v : mesh.vertices) v = v.cwiseProduct(scale);
  if (std::signbit(scale.x()) ^ std::signbit(scale.y()) ^ std::signbit(scale.z())) {
    for (Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

TriangleMesh transformed(TriangleMesh mesh, const Isometry3d& X_BG) {
  for (Vector3d& v : mesh.vertices) v = X_BG * v;
  return mesh;
}

TriangleMesh merged(TriangleMesh first, const TriangleMesh& second) {
  const int offset = static_cast<int>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  first.triangles.reserve(first.triangles.size() + second.triangles.size());
  for (const Vector3i& t : second.triangles) first.triangles.emplace_back(t + Vector3i::Constant(offset));
  return first;
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.triangles.reserve(mesh.triangles.size());
  PointNumbers numbers(mesh.vertices.size() / 6);  // as of a mesh whose triangles share no vertices
  CancelTicks<4096> cancel;
  for (const Vector3i& t : mesh.triangles) {
    cancel.check();
    const auto corner = [&](int i) -> Vector3d { return mesh.vertices[t[i]] + Vector3d::Zero(); };  // -0 becomes +0
    if (corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0)) continue;
    Vector3i indices;
    for (int i = 0; i < 3; ++i) indices[i] = numbers.numberOf(corner(i));
    result.triangles.push_back(indices);
  }
  result.vertices = std::move(numbers.points);
  return result;
}

}  // namespace sdf_ccd
