#include "field/voxel_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "field/uniform/sparse_grid.h"
#include "field/uniform/uniform_shape.h"

namespace sdf_ccd {
namespace {

constexpr int kSide = VoxelBlock::kSide;

/// Squared distances [cells²], a cell being half a voxel; a voxel i fills cells 2i to 2i + 2.
using Squared = std::uint16_t;
constexpr Squared kNone = 40000;  // more than any in a lattice of up to 100 cells

/// Of every point of a lattice to a set of voxels. Voxels are counted from `first` to `last` per axis.
class DistanceTransform {
 public:
  /// @param low   of the lattice, in cells from the block's corner.
  /// @param size  points along each axis.
  DistanceTransform(const Vector3i& low, const Vector3i& size, int first, int last)
      : low_(low), size_(size), first_(first), count_(last - first + 1) {}

  template <class IsIn>
  const std::vector<Squared>& of(const IsIn& is_in) {
    const auto rows = static_cast<std::size_t>(size_.x());
    // Along x: per row of voxels.
    along_x_.assign(rows * count() * count(), kNone);
    for (int k = 0; k < count_; ++k)
      for (int j = 0; j < count_; ++j) {
        Squared* const row = along_x_.data() + rows * (count() * static_cast<std::size_t>(k) + static_cast<std::size_t>(j));
        for (int i = 0; i < count_; ++i)
          if (is_in(first_ + i, first_ + j, first_ + k)) lower(row, 0, i);
      }
    // Along y: per layer of voxels.
    const std::size_t layer = rows * static_cast<std::size_t>(size_.y());
    along_y_.assign(layer * count(), kNone);
    for (int k = 0; k < count_; ++k)
      for (int j = 0; j < count_; ++j) {
        const Squared* const from =
            along_x_.data() + rows * (count() * static_cast<std::size_t>(k) + static_cast<std::size_t>(j));
        if (std::all_of(from, from + rows, [](Squared d) { return d == kNone; })) continue;
        for (int y = 0; y < size_.y(); ++y)
          takeLeast(from, rows, squared(1, y, j), along_y_.data() + layer * static_cast<std::size_t>(k) + rows * static_cast<std::size_t>(y));
      }
    all_.assign(layer * static_cast<std::size_t>(size_.z()), kNone);
    for (int k = 0; k < count_; ++k) {
      const Squared* const from = along_y_.data() + layer * static_cast<std::size_t>(k);
      if (std::all_of(from, from + layer, [](Squared d) { return d == kNone; })) continue;
      for (int z = 0; z < size_.z(); ++z)
        takeLeast(from, layer, squared(2, z, k), all_.data() + layer * static_cast<std::size_t>(z));
    }
    return all_;
  }

 private:
  std::size_t count() const { return static_cast<std::size_t>(count_); }

  /// From a lattice point to a voxel along an axis.
  Squared squared(int axis, int point, int voxel) const {
    const int p = low_[axis] + point, begin = 2 * (first_ + voxel);
    const int away = std::max({0, begin - p, p - begin - 2});
    return static_cast<Squared>(away * away);
  }
  void lower(Squared* row, int axis, int voxel) const {
    for (int p = 0; p < size_[axis]; ++p) row[p] = std::min(row[p], squared(axis, p, voxel));
  }
  static void takeLeast(const Squared* from, std::size_t size, Squared more, Squared* to) {
    for (std::size_t i = 0; i < size; ++i) {
      const auto sum = static_cast<Squared>(from[i] + more);
      to[i] = std::min(to[i], sum);
    }
  }

  Vector3i low_, size_;
  int first_, count_;
  std::vector<Squared> along_x_, along_y_, all_;
};

AlignedBox3d boxOf(const VoxelBlock& block, const VoxelPlace& place) {
  AlignedBox3d box;
  for (int z = 0; z < kSide; ++z)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        if (!block.occupied[VoxelBlock::index(x, y, z)]) continue;
        box.extend(place.origin + place.size * Vector3d(x, y, z));
        box.extend(place.origin + place.size * Vector3d(x + 1, y + 1, z + 1));
      }
  return box;
}

}  // namespace

TriangleMesh voxelSurface(const VoxelBlock& block, const VoxelPlace& place) {
  constexpr int kCorners = kSide + 1;
  TriangleMesh mesh;
  std::vector<int> vertices(std::size_t{kCorners} * kCorners * kCorners, -1);
  const auto vertex = [&](const Vector3i& corner) {
    int& known = vertices[(static_cast<std::size_t>(corner.z()) * kCorners + static_cast<std::size_t>(corner.y())) *
                              kCorners +
                          static_cast<std::size_t>(corner.x())];
    if (known < 0) {
      known = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(place.origin + place.size * corner.cast<double>());
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
            // a b c d turns about +axis.
            mesh.triangles.push_back(upper ? Vector3i(a, b, c) : Vector3i(a, c, b));
            mesh.triangles.push_back(upper ? Vector3i(a, c, d) : Vector3i(a, d, c));
          }
      }
  return mesh;
}

std::optional<DistanceField> voxelField(const VoxelBlock& block, const VoxelPlace& place, double band) {
  const AlignedBox3d box = boxOf(block, place);
  if (box.isEmpty()) return std::nullopt;
  FieldOptions options;
  options.max_error.reset();
  options.cells.reset();
  const double cell = 0.5 * place.size;
  options.cell_size = cell;
  const double kept = std::clamp(band, 2.0 * cell, 16.0 * cell);  // the lattice stays one of up to 100 cells
  options.band = kept + cell;  // what the grid may be shifted by below
  GridShape shape = uniformShape(box, options);
  shape.band = kept;
  // On the voxels' lattice: the box's corners are, so it is enough that the padding is a whole number of cells.
  const Vector3d shift = (shape.origin - place.origin) / shape.cell;
  const Vector3i low(static_cast<int>(std::floor(shift.x() + 1e-6)), static_cast<int>(std::floor(shift.y() + 1e-6)),
                     static_cast<int>(std::floor(shift.z() + 1e-6)));
  shape.origin = place.origin + shape.cell * low.cast<double>();
  const Vector3i points = shape.cells().array() + 1;

  const auto isIn = [&](int x, int y, int z) {
    const bool inside = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < kSide;
    return inside && block.occupied[VoxelBlock::index(x, y, z)];
  };
  DistanceTransform outside(low, points, 0, kSide - 1), inside(low, points, -1, kSide);
  const std::vector<Squared>& out = outside.of(isIn);
  const std::vector<Squared>& in = inside.of([&](int x, int y, int z) { return !isIn(x, y, z); });
  // What is beyond the free voxels around the block is free too; there `out` counts.
  const auto distance = [&](const Vector3i& p) {
    const std::size_t i = (static_cast<std::size_t>(p.z()) * static_cast<std::size_t>(points.y()) +
                           static_cast<std::size_t>(p.y())) *
                              static_cast<std::size_t>(points.x()) +
                          static_cast<std::size_t>(p.x());
    const double squared = out[i] > 0 ? double(out[i]) : double(in[i]);
    return (out[i] > 0 ? 1.0 : -1.0) * shape.cell * std::sqrt(squared);
  };

  GridData data;
  data.corners.resize(shape.cornerCount());
  const Vector3i corners = shape.bricks.array() + 1;
  for (Vector3i c(0, 0, 0); c.z() < corners.z(); ++c.z())
    for (c.y() = 0; c.y() < corners.y(); ++c.y())
      for (c.x() = 0; c.x() < corners.x(); ++c.x())
        data.corners[shape.cornerIndex(c)] = static_cast<float>(distance(GridShape::kBrick * c));

  data.slots.assign(shape.brickCount(), SparseGrid::kFar);
  std::vector<float> samples;
  double largest = 0.0;
  std::array<float, GridShape::kSamples> of_brick;
  for (Vector3i b(0, 0, 0); b.z() < shape.bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < shape.bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < shape.bricks.x(); ++b.x()) {
        double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
        std::size_t at = 0;
        for (int z = 0; z < GridShape::kSide; ++z)
          for (int y = 0; y < GridShape::kSide; ++y)
            for (int x = 0; x < GridShape::kSide; ++x) {
              const double metres = distance(GridShape::kBrick * b + Vector3i(x, y, z));
              of_brick[at++] = static_cast<float>(metres);
              nearest = std::min(nearest, std::abs(metres));
              farthest = std::max(farthest, std::abs(metres));
            }
        // Samples are a cell apart: between them it is no nearer than this by half of the cell's diagonal.
        if (nearest - kHalfSqrt3 * shape.cell > shape.band + shape.cell) continue;
        data.slots[shape.brickIndex(b)] = static_cast<std::int32_t>(samples.size() / GridShape::kSamples);
        samples.insert(samples.end(), of_brick.begin(), of_brick.end());
        largest = std::max(largest, farthest);
      }
  shape.step = GridShape::stepFor(std::max(largest, shape.cell));
  data.samples.reserve(samples.size());
  for (const float metres : samples) data.samples.push_back(shape.inSteps(metres));
  return DistanceField(std::make_shared<const SparseGrid>(shape, std::move(data)));
}

}  // namespace sdf_ccd
