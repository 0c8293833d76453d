#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// An indexed triangle mesh; counter-clockwise triangles seen from outside.
struct TriangleMesh {
  std::vector<Vector3d> vertices;   ///< [m]
  std::vector<Vector3i> triangles;  ///< indices into `vertices`
};

/// Throws std::invalid_argument, naming the first bad element, if the mesh has no triangle, a vertex that is not
/// finite, an index out of range, an extent above 1e6 m or below 1e-9 m, or a point farther than 1e9 m from the origin.
void validate(const TriangleMesh& mesh);

/// Box around the vertices that triangles use; empty for an empty mesh.
AlignedBox3d boundingBox(const TriangleMesh& mesh);

/// Vector normal of a triangle: twice its area long, pointing outside [m²]. Zero for a degenerate triangle.
Vector3d areaNormal(const TriangleMesh& mesh, int triangle);

/// True if every edge is used as often in one direction as in the other: then the winding number is a whole number if
/// it is defined, and changes only across a triangle.
bool isClosed(const TriangleMesh& mesh);

/// Total area [m²].
double surfaceArea(const TriangleMesh& mesh);

/// Signed volume by the divergence theorem [m³], about the box's centre: the solid's volume if the mesh is closed.
double signedVolume(const TriangleMesh& mesh);

/// The mesh scaled along the axes. A mirroring scale (negative determinant) flips the triangles, so that
/// the outside stays outside.
/// @throws std::invalid_argument if a factor is zero or not finite.
TriangleMesh scaled(TriangleMesh mesh, const Vector3d& scale);

/// The mesh moved from its frame G to frame B.
TriangleMesh transformed(TriangleMesh mesh, const Isometry3d& X_BG);

/// Both meshes in one, without welding.
TriangleMesh merged(TriangleMesh first, const TriangleMesh& second);

/// Vertices at exactly the same position merged, unused vertices and triangles with two equal corners dropped.
TriangleMesh welded(const TriangleMesh& mesh);

/// Properties of a mesh, determined before a field is built from it.
struct MeshQuality {
  int triangles = 0;
  int degenerate_triangles = 0;  ///< without area
  int components = 0;            ///< connected over shared edges
  int boundary_edges = 0;        ///< used by one triangle
  int non_manifold_edges = 0;    ///< used by more than two
  int misoriented_edges = 0;     ///< used by two triangles that disagree about the outside
  int inverted_components = 0;   ///< closed components that were inside out (flipped by orientOutward())
  int inverted_sheets = 0;       ///< open parts whose back faced the outside (flipped, too)
  int negative_triangles = 0;    ///< of closed components that intersect themselves: still inside out, as they bound
                                 ///< lobes with a negative winding number
  int duplicate_triangles = 0;   ///< left out because another triangle has the same corners
  double duplicate_area = 0.0;   ///< of those [m²]
  int hidden_triangles = 0;      ///< left out: both sides of walls inside a solid
  double hidden_area = 0.0;      ///< of those, both sides [m²]
  int wall_triangles = 0;        ///< kept: both sides of walls without thickness that have the outside on both sides
  double volume = 0.0;           ///< signed, of the oriented mesh [m³]
  double area = 0.0;             ///< [m²]
  AlignedBox3d box;              ///< [m]
  bool doubtful = false;         ///< winding numbers may cancel each other inside solids, or fill cavities
  bool sign_trusted = false;     ///< closed after orientation, and not doubtful: inside and outside are certain
};

/// A mesh as orientOutward() returns it, and what was found on the way.
struct OrientedMesh {
  TriangleMesh mesh;
  MeshQuality quality;
};

/// Orients triangles so that neighbours agree and that a point is inside the solid if the winding number is not zero.
/// Vertices at the same position are welded.
///
/// A closed component that no other closed one contains is flipped to enclose positive volume; one inside others stays
/// unchanged: a cavity if it faces its inside, else a solid within a solid. If all components that no other one
/// contains are inside out, the whole file is, and everything is flipped. Open parts are flipped if their back is
/// visible from outside.
///
/// The mesh is doubtful if one of several parts had to be flipped, is drawn in both orientations, or intersects itself
/// so that it is inside out in places; if a cavity does not lie in exactly one other part, apart from it; or if a wall
/// without thickness remains.
///
/// Of triangles with the same corners one is kept. There are two exceptions. A face that two parts share, one part
/// within the other, is kept once per part. Of a wall drawn from both sides whose border lies on other triangles, both
/// sides are left out if they are certainly inside a solid, and kept otherwise: then they face opposite directions, add
/// nothing to any winding number, and distances to them are positive on both sides. The quality report counts all of
/// these.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
OrientedMesh orientOutward(const TriangleMesh& mesh);

/// One line of text: "300 triangles, closed, volume 1.2e-3 m^3, sign trusted".
std::string summary(const MeshQuality& quality);

/// A one-line warning for users who rely on inside and outside: that the sign is not trusted, or parts were flipped.
/// Empty if there is nothing to warn about.
std::string warningOf(const MeshQuality& quality);

/// Reads a mesh: STL (binary also when it begins with `solid`; text), OBJ, OFF, PLY and DAE, by the name's ending.
/// Polygons are triangulated, lines and points ignored; vertices equal up to 2^-24 of the longest side are welded. DAE
/// is read by assimp, which has the digits of a float; where these would move a vertex by more than 0.1 mm, because the
/// mesh is far from its origin, it is refused.
///
/// Each mesh is read in a process of its own, so that a file that makes the reader crash, hang or exhaust memory only
/// causes an error here. The process has no access to files or the network, at most 512 MiB of memory plus 32 times the
/// file's size (never more than three quarters of the computer's), 5 s of processor time plus 1 s per MiB, and six
/// times that of wall-clock time. It adds some 4 ms to the reading, that of DAE 20 ms. The programs, sdf_ccd_read and
/// sdf_ccd_read_with_libraries, are searched in lib/sdf_ccd beside the library, or at the path in the environment
/// variable SDF_CCD_READER; without them no mesh can be read.
///
/// A DAE mesh is placed as rviz draws it: `<unit meter="…">` is applied, the file's up-axis is not. The material
/// library of an OBJ file is not opened. Not supported: COLLADA's `<convex_mesh>`, `<trifans>`, `<skew>`, polygons with
/// holes, turns about an axis that has not length 1, and `.zae`; binary OFF.
/// @param bytes  the whole file's content.
/// @param name   the file's name; its ending chooses the format, and it appears in errors.
/// @return triangles [m], in the file's frame; every triangle with finite corners.
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, no triangle, not finite, "the
/// reader crashed (SIGSEGV)", "the reader was stopped: it needed more than 512 MiB"; Cancelled, if a CancelScope
/// requests it.
TriangleMesh parseMesh(const std::string& bytes, const std::string& name);

/// The same from a file on disk, of up to 1 GiB: no device, pipe or socket.
TriangleMesh loadMesh(const std::string& path);

/// Boundary of the occupied space of an OctoMap (`.bt` or `.ot`, also the headerless `.bt` of 2010): two triangles for
/// each face between an occupied voxel of the finest size and one that is not occupied. Unknown space counts as free.
///
/// Vertices lie exactly on the voxel grid (a whole number times the resolution) and are shared. The surface is closed,
/// but not a manifold: where two voxels touch only at an edge, four faces meet there, and where they touch at a corner
/// a vertex belongs to both. Distances and signs are not affected; code that needs a manifold must treat such meshes
/// separately (GeometryDescription::watertight_voxels).
/// @param bytes  the whole file's content.
/// @param name   the file's name, which appears in errors.
/// @param resolution  set to the voxels' size [m].
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, damaged, nothing occupied, a tree
/// of another type than OcTree and ColorOcTree, a build without OctoMap, more faces than accepted for the file's size
/// (2 million plus 8,000 per byte, at most 25 million: 19 bytes can encode 10 billion); Cancelled. The file is read by
/// a process of its own, like meshes (parseMesh()), with 512 MiB of memory plus 2,000 times the file's size, at most 6
/// GiB.
TriangleMesh parseOctomapSurface(const std::string& bytes, const std::string& name, double& resolution);

/// The same from a file on disk, of up to 1 GiB: no device, pipe or socket.
TriangleMesh loadOctomapSurface(const std::string& path, double& resolution);

}  // namespace sdf_ccd
