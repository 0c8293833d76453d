#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

#include "sdf_ccd/mesh.h"

/// Mesh files in memory, as other programs write them.
namespace sdf_ccd::test {

inline std::string text(const Vector3d& p) {
  std::ostringstream out;
  out.precision(17);
  out << p.x() << " " << p.y() << " " << p.z();
  return out.str();
}

inline std::string binaryStl(const TriangleMesh& mesh, const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, '\0');
  const auto append = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);  // little-endian machines only
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Vector3i& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append(0.0f);
    for (int corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) append(static_cast<float>(mesh.vertices[t[corner]][axis]));
    }
    append(std::uint16_t{0});
  }
  return bytes;
}

inline std::string asciiStl(const TriangleMesh& mesh) {
  std::string out = "solid name\n";
  for (const Vector3i& t : mesh.triangles) {
    out += "  facet normal 0 0 0\n    outer loop\n";
    for (int corner = 0; corner < 3; ++corner) out += "      vertex " + text(mesh.vertices[t[corner]]) + "\n";
    out += "    endloop\n  endfacet\n";
  }
  return out + "endsolid name\n";
}

inline std::string obj(const TriangleMesh& mesh) {
  std::string out = "mtllib absent.mtl\nusemtl steel\n";
  for (const Vector3d& v : mesh.vertices) out += "v " + text(v) + "\n";
  for (const Vector3i& t : mesh.triangles) out += "f " + text((t + Vector3i::Ones()).cast<double>()) + "\n";
  return out;
}

inline std::string off(const TriangleMesh& mesh) {
  std::string out =
      "OFF\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Vector3d& v : mesh.vertices) out += text(v) + "\n";
  for (const Vector3i& t : mesh.triangles) out += "3 " + text(t.cast<double>()) + "\n";
  return out;
}

inline std::string ply(const TriangleMesh& mesh) {
  std::string out = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                    std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vector3d& v : mesh.vertices) out += text(v) + "\n";
  for (const Vector3i& t : mesh.triangles) out += "3 " + text(t.cast<double>()) + "\n";
  return out;
}

/// With a colour at each vertex and an element between vertices and faces.
inline std::string binaryPly(const TriangleMesh& mesh, bool is_big_endian) {
  std::string out = std::string("ply\nformat binary_") + (is_big_endian ? "big" : "little") + "_endian 1.0\n" +
                    "comment made by hand\nelement vertex " + std::to_string(mesh.vertices.size()) +
                    "\nproperty uchar red\nproperty double x\nproperty float y\nproperty float z\n" +
                    "element camera 1\nproperty list ushort short numbers\nelement face " +
                    std::to_string(mesh.triangles.size()) +
                    "\nproperty list uchar uint vertex_index\nproperty int16 flags\nend_header\n";
  const auto append = [&](const auto& value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);  // little-endian machines only
    out += is_big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  };
  for (const Vector3d& v : mesh.vertices) {
    append(std::uint8_t{200});
    append(v.x());
    append(static_cast<float>(v.y()));
    append(static_cast<float>(v.z()));
  }
  append(std::uint16_t{2});
  append(std::int16_t{-7});
  append(std::int16_t{9});
  for (const Vector3i& t : mesh.triangles) {
    append(std::uint8_t{3});
    for (int i = 0; i < 3; ++i) append(static_cast<std::uint32_t>(t[i]));
    append(std::int16_t{1});
  }
  return out;
}

/// One geometry, with a line beside its triangles, under `node` (transforms and instances, see kDaeInstance).
constexpr const char* kDaeInstance = "<instance_geometry url=\"#g\"/>";

inline std::string dae(const TriangleMesh& mesh, const std::string& asset, const std::string& node) {
  std::string positions, indices;
  for (const Vector3d& v : mesh.vertices) positions += text(v) + " ";
  for (const Vector3i& t : mesh.triangles) indices += text(t.cast<double>()) + " ";
  const std::string count = std::to_string(mesh.vertices.size());
  return "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
         "<asset>" +
         asset +
         "</asset>"
         "<library_geometries><geometry id=\"g\"><mesh>"
         "<source id=\"p\"><float_array id=\"a\" count=\"" +
         std::to_string(3 * mesh.vertices.size()) + "\">" + positions +
         "</float_array><technique_common><accessor source=\"#a\" count=\"" + count +
         "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
         "<lines count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1</p></lines>"
         "<triangles count=\"" +
         std::to_string(mesh.triangles.size()) + "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" +
         indices +
         "</p></triangles>"
         "</mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id=\"s\">" +
         node +
         "</visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

}  // namespace sdf_ccd::test
