#include "parse_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh_formats.h"

namespace sdf_ccd {
namespace {

TriangleMesh parse(const std::string& text, const std::string& format) {
  if (format == "stl") return parseStl(text);
  if (format == "obj") return parseObj(text);
  if (format == "ply") return parsePly(text);
  return parseOff(text);
}

/// Welds vertices that are equal up to the last digits of a float in a mesh of this size, and to a micrometre, as
/// corners are that were printed or computed apart: the first of them stays. Others keep all of their digits.
TriangleMesh weldedUpToDigits(const TriangleMesh& mesh) {
  constexpr double kDigits = 0x1p-24, kMaxStep = 1e-6;  // [m]
  const AlignedBox3d box = boundingBox(mesh);
  const double size = box.sizes().maxCoeff(), step = std::min(kDigits * size, kMaxStep);
  if (!(size > 0.0 && std::isfinite(size))) return welded(mesh);  // validate() tells what is not finite
  TriangleMesh snapped = mesh;
  for (Vector3d& p : snapped.vertices) p = ((p - box.min()) / step).array().round();
  TriangleMesh result = welded(snapped);
  std::size_t kept = result.triangles.size();
  for (auto t = mesh.triangles.rbegin(); t != mesh.triangles.rend(); ++t) {
    const auto &a = snapped.vertices[(*t)[0]], &b = snapped.vertices[(*t)[1]], &c = snapped.vertices[(*t)[2]];
    if (a == b || b == c || c == a) continue;  // left out by welded()
    const Vector3i& corners = result.triangles[--kept];
    for (int k = 0; k < 3; ++k)
      result.vertices[corners[k]] = mesh.vertices[(*t)[k]] + Vector3d::Zero();  // -0 becomes +0
  }
  return result;
}

}  // namespace

TriangleMesh finishedMesh(const TriangleMesh& mesh) {
  TriangleMesh finished = weldedUpToDigits(mesh);
  validate(finished);
  return finished;
}

std::string withoutByteOrderMark(const std::string& bytes) {
  constexpr const char* kMark = "\xEF\xBB\xBF";
  return bytes.rfind(kMark, 0) == 0 ? bytes.substr(3) : bytes;
}

TriangleMesh parseMeshUnconfined(const std::string& bytes, const std::string& format) {
  const std::string text = withoutByteOrderMark(bytes);
  return finishedMesh(parse(text, format));
}

}  // namespace sdf_ccd
