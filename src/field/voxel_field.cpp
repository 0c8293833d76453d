#include "field/voxel_field.h"

#include <algorithm>
#include <vector>

#include "common/lattice.h"
#include "field/field_access.h"
#include "field/lattice_grid.h"

namespace sdf_ccd {
namespace {

constexpr int kBlockSide = VoxelBlock::kSide;

/// Voxels outside the block are free.
bool isOccupied(const VoxelBlock& block, const Vector3i& v) {
  return v.minCoeff() >= 0 && v.maxCoeff() < kBlockSide && block.occupied[VoxelBlock::index(v.x(), v.y(), v.z())];
}

AlignedBox3d boxOf(const VoxelBlock& block, const VoxelLattice& lattice) {
  AlignedBox3d box;
  forEachPoint(Vector3i::Constant(kBlockSide), [&](const Vector3i& v) {
    if (!isOccupied(block, v)) return;
    box.extend(lattice.origin + lattice.size * v.cast<double>());
    box.extend(lattice.origin + lattice.size * (v + Vector3i::Ones()).cast<double>());
  });
  return box;
}

}  // namespace

TriangleMesh voxelSurface(const VoxelBlock& block, const VoxelLattice& lattice) {
  constexpr int kCorners = kBlockSide + 1;
  TriangleMesh mesh;
  std::vector<int> vertices(std::size_t{kCorners} * kCorners * kCorners, -1);
  const auto vertex = [&](const Vector3i& corner) {
    int& known = vertices[indexIn(Vector3i::Constant(kCorners), corner)];
    if (known < 0) {
      known = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(lattice.origin + lattice.size * corner.cast<double>());
    }
    return known;
  };
  forEachPoint(Vector3i::Constant(kBlockSide), [&](const Vector3i& v) {
    if (!isOccupied(block, v)) return;
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        const Vector3i unit = Vector3i::Unit(axis);
        if (isOccupied(block, upper ? Vector3i(v + unit) : Vector3i(v - unit))) continue;
        const Vector3i u = Vector3i::Unit((axis + 1) % 3), w = Vector3i::Unit((axis + 2) % 3);
        const Vector3i low = upper ? Vector3i(v + unit) : v;
        const int a = vertex(low), b = vertex(low + u), c = vertex(low + u + w), d = vertex(low + w);
        // a b c d is counter-clockwise about +axis.
        mesh.triangles.push_back(upper ? Vector3i(a, b, c) : Vector3i(a, c, b));
        mesh.triangles.push_back(upper ? Vector3i(a, c, d) : Vector3i(a, d, c));
      }
  });
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
  // The window has one layer of free voxels around the block. The voxels beyond are free too, and never the nearest
  // free ones of a point in the block.
  distances.compute(kCells, grid.low, shape.cells().array() + 1, Vector3i::Constant(-1), Vector3i::Constant(kBlockSide),
                    [&](const Vector3i& v) { return isOccupied(block, v); });

  GridData data;
  data.corners.resize(shape.cornerCount());
  forEachPoint(shape.bricks.array() + 1, [&](const Vector3i& c) {
    data.corners[shape.cornerIndex(c)] = static_cast<float>(shape.cell * distances.at(GridShape::kBrick * c));
  });

  data.slots.assign(shape.brickCount(), SparseGrid::kFar);
  BrickSamples samples;
  forEachPoint(shape.bricks, [&](const Vector3i& b) {
    if (samples.append(distances, GridShape::kBrick * b, shape)) data.slots[shape.brickIndex(b)] = samples.bricks - 1;
  });
  data.samples = std::move(samples.samples);
  return FieldAccess::make(std::make_shared<const SparseGrid>(shape, std::move(data)));
}

}  // namespace sdf_ccd
