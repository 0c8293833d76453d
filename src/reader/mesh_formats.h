#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads text and binary STL. A binary file may begin with `solid`, and may have bytes after its last triangle.
/// @throws std::runtime_error with the reason: neither text nor binary, shorter than the announced triangles need, or
/// text that ends before its last `endsolid`.
TriangleMesh parseStl(const std::string& bytes);

/// Reads the vertices and polygons (`v`, `f`) of a Wavefront OBJ; all else is skipped, material libraries too.
/// @throws std::runtime_error with the reason if a vertex or a polygon is incomplete or invalid.
TriangleMesh parseObj(const std::string& bytes);

/// Reads text OFF, with or without colours, normals and texture coordinates. Binary OFF, and vertices of other than
/// three coordinates, are refused.
/// @throws std::runtime_error with the reason, also if the file holds fewer elements than its header announces.
TriangleMesh parseOff(const std::string& bytes);

/// Reads PLY, text or binary in either byte order: the elements `vertex` (x, y, z), `face` and `tristrips`
/// (vertex_indices or vertex_index); others are skipped.
/// @throws std::runtime_error with the reason, also if the file holds fewer elements than its header announces.
TriangleMesh parsePly(const std::string& bytes);

/// Reads COLLADA 1.4 and 1.5: the meshes of the scene's nodes and of the nodes they instantiate, skins in their bind
/// shape. The result lies where rviz draws it: the unit is applied, the up-axis is not.
///
/// Reads triangles, polylist, polygons (without holes), trifans and tristrips of a `<mesh>`; lines are skipped.
/// @throws std::runtime_error with the reason: XML that is not well-formed, a reference to a missing element, a node
/// that contains itself, more than 20,000 nodes after instances are expanded.
TriangleMesh parseDae(const std::string& bytes);

}  // namespace sdf_ccd
