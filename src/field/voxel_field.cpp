#include "field/voxel_field.h"

#include <algorithm>
#include <vector>

#include "field/lattice_grid.h"

namespace sdf_ccd {
namespace {

constexpr int kSide = VoxelBlock::kSide;

AlignedBox3d boxOf(const VoxelBlock& block, const VoxelLattice& lattice) {
  AlignedBox3d box;
  for (int z = 0; z < kSide; ++z)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        if (!block.occupied[VoxelBlock::index(x, y, z)]) continue;
        box.extend(lattice.origin + lattice.size * Vector3d(x, y, z));
        box.extend(lattice.origin + lattice.size * Vector3d(x + 1, y + 1, z + 1));
      }
  return box;
}

}  // namespace

TriangleMesh voxelSurface(const VoxelBlock& block, const VoxelLattice& lattice) {
  constexpr int kCorners = kSide + 1;
  TriangleMesh mesh;
  std::vector<int> vertices(std::size_t{kCorners} * kCorners * kCorners, -1);
  const auto vertex = [&](const Vector3i& corner) {
    int& known =
        vertices[(static_cast<std::size_t>(corner.z()) * kCorners + static_cast<std::size_t>(corner.y())) * kCorners +
                 static_cast<std::size_t>(corner.x())];
    if (known < 0) {
      known = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(lattice.origin + lattice.size * corner.cast<double>());
    }
    return known;
  };
  const auto isIn = [&](const Vector3i& v) {
    return v.minCoeff() >= 0 && v.maxCoeff() < kSide && block.occupied[VoxelBlock::index(v.x(), v.y(), v.z())];
  };
  for (Vector3i v(0, 0, 0); v.z() < kSide; ++v.z())
    for (v.y() = 0; v.y() < kSide; ++v.y())
      for (v.x() = 0; v.x() < kSide; ++v.x()) {
        if (!isIn(v)) continue;
        for (int axis = 0; axis < 3; ++axis)
          for (const bool upper : {false, true}) {
            const Vector3i unit = Vector3i::Unit(axis);
            if (isIn(upper ? Vector3i(v + unit) : Vector3i(v - unit))) continue;
            const Vector3i u = Vector3i::Unit((axis + 1) % 3), w = Vector3i::Unit((axis + 2) % 3);
            const Vector3i low = upper ? Vector3i(v + unit) : v;
            const int a = vertex(low), b = vertex(low + u), c = vertex(low + u + w), d = vertex(low + w);
            // a b c d is counter-clockwise about +axis.
            mesh.triangles.push_back(upper ? Vector3i(a, b, c) : Vector3i(a, c, b));
            mesh.triangles.push_back(upper ? Vector3i(a, c, d) : Vector3i(a, d, c));
          }
      }
  return mesh;
}

std::optional<DistanceField> voxelField(const VoxelBlock& block, const VoxelLattice& lattice, double band) {
  const AlignedBox3d box = boxOf(block, lattice);
  if (box.isEmpty()) return std::nullopt;
  constexpr int kCells = 2;  // along a voxel's side
  FieldOptions options;
  options.max_error.reset();
  options.cells.reset();
  options.cell_size = lattice.size / kCells;
  options.band = std::min(band, 16.0 * *options.cell_size);  // limits the lattice to 100 cells along an axis
  LatticeGrid grid(box, lattice.origin, options);
  GridShape& shape = grid.shape;

  LatticeDistance distances;
  const auto isIn = [&](int x, int y, int z) {
    const bool inside = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < kSide;
    return inside && block.occupied[VoxelBlock::index(x, y, z)];
  };
  // The window has one layer of free voxels around the block. The voxels beyond are free too, and never the nearest
  // free ones of a point in the block.
  distances.compute(kCells, grid.low, shape.cells().array() + 1, Vector3i::Constant(-1), Vector3i::Constant(kSide),
                    isIn);

  GridData data;
  data.corners.resize(shape.cornerCount());
  const Vector3i corners = shape.bricks.array() + 1;
  for (Vector3i c(0, 0, 0); c.z() < corners.z(); ++c.z())
    for (c.y() = 0; c.y() < corners.y(); ++c.y())
      for (c.x() = 0; c.x() < corners.x(); ++c.x())
        data.corners[shape.cornerIndex(c)] = static_cast<float>(shape.cell * distances.at(GridShape::kBrick * c));

  data.slots.assign(shape.brickCount(), SparseGrid::kFar);
  BrickSamples samples;
  for (Vector3i b(0, 0, 0); b.z() < shape.bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < shape.bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < shape.bricks.x(); ++b.x())
        if (samples.take(distances, GridShape::kBrick * b, shape)) data.slots[shape.brickIndex(b)] = samples.bricks - 1;
  data.samples = std::move(samples.samples);
  return DistanceField(std::make_shared<const SparseGrid>(shape, std::move(data)));
}

}  // namespace sdf_ccd
