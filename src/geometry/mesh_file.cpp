#include "sdf_ccd/geometry/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "collada.h"
#include "mended_bytes.h"
#include "polygon.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

std::string ending(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::size_t slash = name.find_last_of("/\\");
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return "";
  std::string result = name.substr(dot + 1);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return result;
}

Eigen::Affine3d toEigen(const aiMatrix4x4& m) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.matrix().topRows<3>() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return result;
}

struct Placement {
  int first_vertex;
  bool mirrored;
};

/// Appends a polygon's triangles; lines and points have none.
void appendFace(const aiMesh& mesh, const aiFace& face, const Placement& placement, TriangleMesh& result) {
  std::vector<int> vertices;
  std::vector<Vector3d> corners;
  for (unsigned i = 0; i < face.mNumIndices; ++i) {
    if (face.mIndices[i] >= mesh.mNumVertices) {
      throw std::runtime_error("a face names vertex " + std::to_string(face.mIndices[i]) + " of " +
                               std::to_string(mesh.mNumVertices));
    }
    vertices.push_back(placement.first_vertex + static_cast<int>(face.mIndices[i]));
    corners.push_back(result.vertices[vertices.back()]);
  }
  for (const Vector3i& local : triangulatePolygon(corners)) {
    Vector3i t(vertices[local[0]], vertices[local[1]], vertices[local[2]]);
    if (placement.mirrored) std::swap(t[1], t[2]);
    result.triangles.push_back(t);
  }
}

/// Appends a node's triangles and its children's; X is the node's place in the file's frame.
void gather(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& X, TriangleMesh& result) {
  const bool mirrored = X.linear().determinant() < 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    if (result.vertices.size() + mesh.mNumVertices > std::numeric_limits<int>::max()) {
      throw std::runtime_error("more than 2^31 vertices");
    }
    const int offset = static_cast<int>(result.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      result.vertices.push_back(X * Vector3d(p.x, p.y, p.z));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) appendFace(mesh, mesh.mFaces[f], {offset, mirrored}, result);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    gather(scene, *node.mChildren[i], X * toEigen(node.mChildren[i]->mTransformation), result);
  }
}

TriangleMesh import(const std::string& bytes, const std::string& format) {
  Assimp::Importer importer;
  // No post-processing: assimp's triangulation aborts the process on damaged faces where asserts are compiled in.
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, format.c_str());
  if (!scene || !scene->mRootNode) throw std::runtime_error(importer.GetErrorString());
  TriangleMesh mesh;
  // As rviz: what hangs below the root ignores the root's transform, where assimp puts COLLADA's unit and up-axis.
  const aiNode& root = *scene->mRootNode;
  if (root.mNumMeshes > 0 && root.mNumChildren == 0) {
    gather(*scene, root, toEigen(root.mTransformation), mesh);
  } else {
    gather(*scene, root, Eigen::Affine3d::Identity(), mesh);
  }
  return mesh;
}

TriangleMesh parse(const std::string& bytes, const std::string& name) {
  if (bytes.empty()) throw std::runtime_error("empty");
  if (bytes.size() > kMaxBytes) throw std::runtime_error("larger than 1 GiB");
  const std::string format = ending(name);
  if (format.empty()) throw std::runtime_error("no file name ending, which would tell the format");
  if (format == "ply") requireSoundPly(bytes);
  if (format == "off") requireSoundOff(bytes);
  const double meter = format == "dae" ? inspectCollada(bytes) : 1.0;
  TriangleMesh mesh = import(format == "stl" ? mendedStl(bytes) : bytes, format);
  for (Vector3d& v : mesh.vertices) v *= meter;
  mesh = welded(mesh);
  validate(mesh);
  return mesh;
}

}  // namespace

TriangleMesh parseMesh(const std::string& bytes, const std::string& name) {
  try {
    return parse(bytes, name);
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

TriangleMesh loadMesh(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::string bytes;
  try {
    bytes.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  } catch (const std::exception&) {
    throw std::runtime_error(path + ": cannot be read");
  }
  if (file.bad()) throw std::runtime_error(path + ": cannot be read");
  return parseMesh(bytes, path);
}

}  // namespace sdf_ccd
