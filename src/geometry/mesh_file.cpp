#include "sdf_ccd/geometry/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "collada_unit.h"
#include "stl_bytes.h"

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
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      Vector3i t;
      for (int corner = 0; corner < 3; ++corner) {
        if (face.mIndices[corner] >= mesh.mNumVertices) {
          throw std::runtime_error("a face names vertex " + std::to_string(face.mIndices[corner]) + " of " +
                                   std::to_string(mesh.mNumVertices));
        }
        t[corner] = offset + static_cast<int>(face.mIndices[corner]);
      }
      if (mirrored) std::swap(t[1], t[2]);
      result.triangles.push_back(t);
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    gather(scene, *node.mChildren[i], X * toEigen(node.mChildren[i]->mTransformation), result);
  }
}

TriangleMesh import(const std::string& bytes, const std::string& format) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                     aiProcess_Triangulate | aiProcess_SortByPType, format.c_str());
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
  TriangleMesh mesh = import(format == "stl" ? mendedStl(bytes) : bytes, format);
  if (format == "dae") {
    const double meter = colladaUnit(bytes);
    for (Vector3d& v : mesh.vertices) v *= meter;
  }
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
