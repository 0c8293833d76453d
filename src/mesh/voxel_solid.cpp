#include "mesh/voxel_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

/// The corners of triangles as points of a lattice, whose spacing is the shortest edge of the mesh's first triangle.
class Lattice {
 public:
  explicit Lattice(const TriangleMesh& mesh) : mesh_(mesh), box_(boundingBox(mesh)) {
    const Vector3i& t = mesh.triangles.front();
    size_ = kInfinity;
    for (int k = 0; k < 3; ++k) size_ = std::min(size_, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
  }

  double size() const { return size_; }
  const Vector3d& origin() const { return box_.min(); }
  Eigen::Array3d count() const { return (box_.sizes() / size_).array().round(); }

  /// Sets the lattice point of a vertex, and raises `moved` to the distance between them [m].
  /// @return false if the vertex is not on the lattice.
  bool place(int vertex, Vector3i& point, double& moved) const {
    constexpr double kOff =
        1e-4;  // of a voxel: coordinates of 65536 of them, rounded to single precision, are off by less
    const Vector3d exact = (mesh_.vertices[vertex] - origin()) / size_;
    point = exact.array().round().cast<int>();
    const Vector3d off = exact - point.cast<double>();
    moved = std::max(moved, off.norm() * size_);
    return off.lpNorm<Eigen::Infinity>() < kOff;
  }

 private:
  const TriangleMesh& mesh_;
  AlignedBox3d box_;
  double size_ = 0.0;
};

/// The axis-aligned square of which a triangle is one half.
struct Square {
  Vector3i low, extent;

  bool isFace() const { return extent.minCoeff() == 0 && extent.maxCoeff() == 1 && extent.sum() == 2; }
};

}  // namespace

std::shared_ptr<const VoxelSolid> VoxelSolid::of(const TriangleMesh& mesh, std::uint64_t max_voxels) {
  if (mesh.triangles.empty()) return nullptr;
  const Lattice lattice(mesh);
  const Eigen::Array3d count = lattice.count();
  // Rows along x take whole words. A single row of that many would not be counted by integers.
  const double voxels = 64.0 * std::ceil(count.x() / 64.0) * count.y() * count.z();
  if (!(lattice.size() > 0.0) || !(count.minCoeff() >= 1.0) || !(voxels <= double(max_voxels))) return nullptr;
  if (count.maxCoeff() > double(std::numeric_limits<int>::max())) return nullptr;

  std::shared_ptr<VoxelSolid> solid(new VoxelSolid);
  solid->size_ = lattice.size();
  solid->origin_ = lattice.origin();
  solid->count_ = count.cast<int>();
  solid->words_ = static_cast<std::size_t>(solid->count_.x() + 63) / 64;

  // Voxels along z are occupied between one face across z and the next.
  using Face = std::array<int, 3>;  // y, x, z
  std::vector<Face> across_z;
  std::vector<Square> squares;
  squares.reserve(mesh.triangles.size());
  for (const Vector3i& triangle : mesh.triangles) {
    Vector3i corners[3];
    for (int k = 0; k < 3; ++k)
      if (!lattice.place(triangle[k], corners[k], solid->moved_)) return nullptr;
    Square& square = squares.emplace_back();
    square.low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    square.extent = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) - square.low;
    if (!square.isFace()) return nullptr;
    if (square.extent.z() == 0) across_z.push_back({square.low.y(), square.low.x(), square.low.z()});
  }
  std::sort(across_z.begin(), across_z.end());
  across_z.erase(std::unique(across_z.begin(), across_z.end()), across_z.end());
  if (across_z.size() % 2 != 0) return nullptr;
  solid->bits_.assign(
      solid->words_ * static_cast<std::size_t>(solid->count_.y()) * static_cast<std::size_t>(solid->count_.z()), 0);
  for (std::size_t i = 0; i < across_z.size(); i += 2) {
    const auto& [y, x, begin] = across_z[i];
    const auto& [other_y, other_x, end] = across_z[i + 1];
    if (y != other_y || x != other_x) return nullptr;
    for (int z = begin; z < end; ++z) solid->row(y, z)[x / 64] |= std::uint64_t{1} << (x % 64);
  }
  const auto isBoundary = [&](const Square& square) {
    const Vector3i &above = square.low, below = above - (Vector3i::Ones() - square.extent);
    return solid->isIn(above.x(), above.y(), above.z()) != solid->isIn(below.x(), below.y(), below.z());
  };
  const bool are_faces = std::all_of(squares.begin(), squares.end(), isBoundary);
  return are_faces && double(mesh.triangles.size()) == 2.0 * solid->faces() ? solid : nullptr;
}

template <typename Test>
bool VoxelSolid::anyVoxelAround(const Vector3d& p, double slack, const Test& test) const {
  const Vector3d around = Vector3d::Constant(slack);
  const Vector3i low = ((p - around - origin_) / size_).array().floor().cast<int>();
  const Vector3i high = ((p + around - origin_) / size_).array().floor().cast<int>();
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x)
        if (test(x, y, z)) return true;
  return false;
}

bool VoxelSolid::touches(const Vector3d& p, double slack) const {
  const AlignedBox3d within = box();
  const Vector3d nearest = p.cwiseMax(within.min()).cwiseMin(within.max());
  if (!((p - nearest).lpNorm<Eigen::Infinity>() <= slack)) return false;
  return anyVoxelAround(nearest, slack, [this](int x, int y, int z) { return isIn(x, y, z); });
}

bool VoxelSolid::contains(const Vector3d& p, double slack) const {
  if (!box().contains(p)) return false;
  return !anyVoxelAround(p, slack, [this](int x, int y, int z) { return !isIn(x, y, z); });
}

void VoxelSolid::runs(int y, int z, std::vector<Run>& found) const {
  found.clear();
  if (y < 0 || z < 0 || y >= count_.y() || z >= count_.z()) return;
  const std::uint64_t* const bits = row(y, z);
  for (std::size_t w = 0; w < words_; ++w) {
    for (std::uint64_t left = bits[w]; left != 0;) {
      const int begin = __builtin_ctzll(left);
      const std::uint64_t ends = ~(left | ((std::uint64_t{1} << begin) - 1));
      const int end = ends == 0 ? 64 : __builtin_ctzll(ends);
      const int word = static_cast<int>(64 * w);
      if (!found.empty() && found.back().end == word + begin) {
        found.back().end = word + end;
      } else {
        found.push_back({word + begin, word + end});
      }
      left = end == 64 ? 0 : left >> end << end;
    }
  }
}

/// The number of faces between an occupied voxel and a free one: that of the mesh, if it is the boundary of these
/// voxels.
double VoxelSolid::faces() const {
  const std::vector<std::uint64_t> nothing(words_, 0);
  const auto rowOrNone = [&](int y, int z) {
    return y < count_.y() && z < count_.z() && y >= 0 && z >= 0 ? row(y, z) : nothing.data();
  };
  double faces = 0.0;
  for (int z = 0; z <= count_.z(); ++z)
    for (int y = 0; y <= count_.y(); ++y) {
      const std::uint64_t *const here = rowOrNone(y, z), *const before_y = rowOrNone(y - 1, z),
                                 *const before_z = rowOrNone(y, z - 1);
      std::uint64_t carried = 0;
      for (std::size_t w = 0; w < words_; ++w) {
        const std::uint64_t bits = here[w], shifted = bits << 1 | carried;
        carried = bits >> 63;
        faces += __builtin_popcountll(bits ^ before_y[w]) + __builtin_popcountll(bits ^ before_z[w]) +
                 __builtin_popcountll(bits ^ shifted);
      }
      // The end of a row that fills its last word has no bit of its own.
      faces += carried != 0;
    }
  return faces;
}

}  // namespace sdf_ccd
