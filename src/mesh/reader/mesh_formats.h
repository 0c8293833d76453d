#pragma once

#include <string>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Reads text and binary STL. A binary file may begin with `solid`, and may have bytes after its last triangle.
/// @throws std::runtime_error with the reason: neither text nor binary, shorter than the announced triangles need, or
/// text that ends before its last `endsolid`.
TriangleMesh parseStl(const std::string& bytes);

/// Reads the vertices and polygons (`v`, `f`) of a Wavefront OBJ; all else is skipped, material libraries too. assimp
/// skips vertices that it does not understand, so that all after them have other numbers, and faces likewise.
/// @throws std::runtime_error with the reason if a vertex or a polygon is incomplete or invalid.
TriangleMesh parseObj(const std::string& bytes);

/// Reads PLY, text or binary in either byte order: the elements `vertex` (x, y, z), `face` and `tristrips`
/// (vertex_indices or vertex_index); others are skipped. assimp leaves out faces of a damaged text, or makes them up.
/// @throws std::runtime_error with the reason, also if the file holds fewer elements than its header announces.
TriangleMesh parsePly(const std::string& bytes);

/// Reads text OFF, with or without colours, normals and texture coordinates. Binary OFF, and vertices of other than
/// three coordinates, are refused. assimp leaves out faces of more than nine corners, and changes invalid indices.
/// @throws std::runtime_error with the reason, also if the file holds fewer elements than its header announces.
TriangleMesh parseOff(const std::string& bytes);

}  // namespace sdf_ccd
