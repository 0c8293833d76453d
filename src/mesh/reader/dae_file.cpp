#include "dae_file.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include "collada_check.h"
#include "common/number_text.h"
#include "parse_mesh.h"
#include "polygon_mesh.h"

namespace sdf_ccd {
namespace {

class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

/// The error without the name that assimp gives to files in memory.
std::string reasonOf(const Assimp::Importer& importer) {
  std::string reason = importer.GetErrorString();
  const std::size_t begin = reason.find("$$$"), end = reason.find_first_of(" :,\"'", begin);
  return begin == std::string::npos ? reason : reason.replace(begin, end - begin, "it");
}

/// @throws std::runtime_error if it is projective, or flattens what it transforms.
Eigen::Affine3d toEigen(const aiMatrix4x4& m) {
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  X.matrix().topRows<3>() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  const bool is_affine = m.d1 == 0.0F && m.d2 == 0.0F && m.d3 == 0.0F && m.d4 == 1.0F;
  if (!is_affine || X.linear().determinant() == 0.0)
    throw std::runtime_error("the transform of a node is projective, or flattens it");
  return X;
}

struct SceneMesh {
  TriangleMesh mesh;
  double farthest = 0.0;  ///< largest number that was rounded to a float, in the mesh's unit
};

/// @param X  transform of the node.
void appendMesh(const aiMesh& part, const Eigen::Affine3d& X, SceneMesh& all) {
  TriangleMesh& mesh = all.mesh;
  if (mesh.vertices.size() + part.mNumVertices > std::numeric_limits<int>::max()) {
    throw std::runtime_error("more than 2^31 vertices");
  }
  const std::size_t first = mesh.vertices.size();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const Vector3d p(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
    mesh.vertices.push_back(X * p);
    const Vector3d sizes = X.linear().cwiseAbs() * p.cwiseAbs() + X.translation().cwiseAbs();
    all.farthest = std::max(all.farthest, sizes.maxCoeff());
  }
  const bool mirrored = X.linear().determinant() < 0.0;
  std::vector<std::int64_t> corners;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    corners.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      corners.push_back(static_cast<std::int64_t>(first + face.mIndices[mirrored ? face.mNumIndices - 1 - k : k]));
    }
    appendPolygon(corners, mesh);
  }
}

/// @param X  transform of the node's parent.
void appendNode(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& X_parent, SceneMesh& all) {
  const Eigen::Affine3d X = X_parent * toEigen(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) appendMesh(*scene.mMeshes[node.mMeshes[i]], X, all);
  const Eigen::Affine3d X_children = node.mParent ? X : Eigen::Affine3d::Identity();
  for (unsigned i = 0; i < node.mNumChildren; ++i) appendNode(scene, *node.mChildren[i], X_children, all);
}

SceneMesh import(const std::string& xml) {
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);
  // Without any of its processing: its triangulation drops what it does not understand.
  const aiScene* scene = importer.ReadFileFromMemory(xml.data(), xml.size(), 0, "dae");
  if (!scene || !scene->mRootNode) throw std::runtime_error(reasonOf(importer));
  SceneMesh all;
  appendNode(*scene, *scene->mRootNode, Eigen::Affine3d::Identity(), all);
  return all;
}

/// @param farthest  largest number that was rounded to a float [m].
void requireDigits(const TriangleMesh& mesh, double farthest) {
  constexpr double kMaxRounding = 1e-4;  // [m]
  const double rounding = farthest * std::numeric_limits<float>::epsilon() / 2.0;
  if (rounding <= kMaxRounding || farthest <= 2.0 * boundingBox(mesh).sizes().maxCoeff()) return;
  throw std::runtime_error("too far from its origin: in floats, coordinates of " + numberText(farthest) +
                           " m are rounded by up to " + numberText(rounding) + " m");
}

}  // namespace

TriangleMesh parseDae(const std::string& bytes) {
  const std::string xml = withoutByteOrderMark(bytes);
  const double unit = checkCollada(xml);
  SceneMesh read = import(xml);
  for (Vector3d& p : read.mesh.vertices) p *= unit;
  TriangleMesh mesh = finishedMesh(read.mesh);
  requireDigits(mesh, unit * read.farthest);
  return mesh;
}

}  // namespace sdf_ccd
