#include "sdf_ccd/field/build_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "build_adaptive.h"
#include "cube_corner.h"
#include "near_triangles.h"
#include "progress_counter.h"
#include "sdf_ccd/geometry/openings.h"
#include "sdf_ccd/geometry/parallel_for.h"

namespace sdf_ccd {
namespace {

double cellSize(const FieldOptions& options, const AlignedBox3d& surface_box) {
  if (options.cell_size) return *options.cell_size;
  return surface_box.sizes().maxCoeff() / *options.cells;
}

GridShape shapeFor(const TriangleMesh& mesh, const FieldOptions& options) {
  GridShape shape;
  shape.surface_box = boundingBox(mesh);
  shape.exact = true;
  shape.cell = cellSize(options, shape.surface_box);
  shape.band = std::max(options.band, 2.0 * shape.cell);
  // Padded so that no value within the band, nor its interpolation, reaches the grid's boundary.
  const double padding = shape.band + 2.0 * shape.cell;
  const Vector3d extent = shape.surface_box.sizes().array() + 2.0 * padding;
  const Vector3d bricks = (extent / (GridShape::kBrick * shape.cell)).array().ceil();
  if (bricks.maxCoeff() > 4096.0) {
    throw std::length_error("field: " + std::to_string(shape.cell) + " m cells need " +
                            std::to_string(bricks.maxCoeff() * GridShape::kBrick) + " along one side, at most 32768");
  }
  shape.bricks = bricks.cast<int>();
  shape.origin = shape.surface_box.center() - 0.5 * shape.cell * shape.cells().cast<double>();
  return shape;
}

/// Signed distances at grid points: of a brick, its halves, their halves, each with the triangles that may be nearest
/// to its places, until those are few.
class Sampler {
 public:
  Sampler(const Solid& solid, const GridShape& shape) : shape_(shape) {
    const TriangleMesh& mesh = solid.boundary();
    // Measured on scans: below, lists are up to six times as fast as the tree; above, slower.
    if (shape.cell < 0.75 * std::sqrt(surfaceArea(mesh) / double(mesh.triangles.size()))) {
      index_.emplace(solid);
    } else {
      surface_.emplace(solid);
    }
  }

  const SignedSurface& surface() const { return index_ ? index_->exact() : *surface_; }

  /// All samples of a brick.
  void fill(const Vector3i& brick, float* samples) const {
    if (!index_) return fillFromTree(brick, samples);
    constexpr std::size_t kMany = 300;
    const Block whole{Vector3i::Zero(), GridShape::kBrick};
    const SpaceCube cube = cubeOf(brick, whole);
    const NearCube found(*index_, cube, surface().nearest(cube.center));
    if (found.near().size() > kMany) {
      fillFromTree(brick, samples);
    } else {
      fill(brick, whole, found.near(), samples);
    }
  }

 private:
  /// A cube of a brick: first cell and side, in cells.
  struct Block {
    Vector3i low;
    int side;
  };

  Vector3d place(const Vector3i& brick, const Vector3d& cells) const {
    return shape_.origin + shape_.cell * ((GridShape::kBrick * brick).cast<double>() + cells);
  }

  SpaceCube cubeOf(const Vector3i& brick, const Block& block) const {
    const Vector3d center = block.low.cast<double>().array() + 0.5 * block.side;
    return {place(brick, center), block.side * shape_.cell};
  }

  void fill(const Vector3i& brick, const Block& block, const NearTriangles& near, float* samples) const {
    constexpr std::size_t kFew = 16;
    if (block.side > 1 && near.size() > kFew) {
      const int half = block.side / 2;
      NearOctants octants(near);
      for (int k = 0; k < 8; ++k) {
        fill(brick, {block.low + half * cubeCorner(k), half}, octants[k], samples);
      }
      return;
    }
    // The far sides belong to the next block, except at the brick's end.
    constexpr int kSide = GridShape::kSide;
    const auto end = [&](int k) {
      return block.low[k] + block.side + (block.low[k] + block.side == GridShape::kBrick);
    };
    DistanceWriter<float> writer(near, samples);
    for (int z = block.low.z(); z < end(2); ++z)
      for (int y = block.low.y(); y < end(1); ++y)
        for (int x = block.low.x(); x < end(0); ++x) {
          writer.add((z * kSide + y) * kSide + x, place(brick, Vector3d(x, y, z)));
        }
  }

  /// Where triangles are small beside cells lists of them are long: each sample starts from its neighbour's triangle.
  void fillFromTree(const Vector3i& brick, float* samples) const {
    constexpr int kSide = GridShape::kSide;
    SignedSurface::Nearest row_start{}, layer_start{};
    for (int z = 0; z < kSide; ++z)
      for (int y = 0; y < kSide; ++y) {
        SignedSurface::Nearest last = y > 0 ? row_start : layer_start;
        for (int x = 0; x < kSide; ++x, ++samples) {
          const Vector3d p = place(brick, Vector3d(x, y, z));
          const bool first = x == 0 && y == 0 && z == 0;
          last = first ? surface().nearest(p) : surface().next(p, last, shape_.cell);
          *samples = static_cast<float>(last.distance);
          if (x == 0) row_start = last;
          if (x == 0 && y == 0) layer_start = last;
        }
      }
  }

  std::optional<SurfaceIndex> index_;  ///< where triangles are not small beside cells
  std::optional<SignedSurface> surface_;
  GridShape shape_;
};

/// Bricks that need samples: the distance at the centre, or a sign that changes between the corners, says that
/// |φ| ≤ band (and its interpolation error) may be met inside.
bool needsSamples(const Sampler& sampler, const GridShape& shape, const std::vector<float>& corners,
                  const Vector3i& brick) {
  const double side = GridShape::kBrick * shape.cell;
  double nearest = TriangleTree::kInfinity;
  int negative = 0;
  for (int k = 0; k < 8; ++k) {
    const float c = corners[shape.cornerIndex(brick + cubeCorner(k))];
    nearest = std::min(nearest, std::abs(double(c)));
    negative += c < 0.0F;
  }
  if (negative % 8 != 0) return true;
  const double needed = shape.band + shape.cell;
  if (nearest > needed + 2.0 * kHalfSqrt3 * side) return false;
  const Vector3d center = shape.origin + side * (brick.cast<double>().array() + 0.5).matrix();
  const double reach = needed + kHalfSqrt3 * side;
  return sampler.surface().tree().closestPoint(center, reach).distance < reach;
}

/// What no sample of a brick exceeds: distances differ by no more than places do.
double largestSample(const GridShape& shape, const std::vector<float>& corners, const Vector3i& brick) {
  double nearest = TriangleTree::kInfinity;
  for (int k = 0; k < 8; ++k) {
    nearest = std::min(nearest, std::abs(double(corners[shape.cornerIndex(brick + cubeCorner(k))])));
  }
  return nearest + 2.0 * kHalfSqrt3 * GridShape::kBrick * shape.cell;
}

std::shared_ptr<const SparseGrid> buildUniform(const Solid& solid, const FieldOptions& options,
                                               const Progress& progress) {
  GridShape shape = shapeFor(solid.boundary(), options);
  const std::size_t bricks = shape.brickCount();
  const std::size_t coarse_bytes = shape.cornerCount() * sizeof(float) + bricks * sizeof(std::int32_t);
  const auto refuse = [&](std::size_t bytes) {
    throw std::length_error(
        "field: " + std::to_string(bytes >> 20) + " MB with cells of " + std::to_string(shape.cell) +
        " m, more than the " + std::to_string(options.max_bytes >> 20) + " MB allowed; cells of " +
        std::to_string(shape.cell * std::sqrt(double(bytes) / double(options.max_bytes))) + " m would fit");
  };
  if (coarse_bytes > options.max_bytes) refuse(coarse_bytes);

  const Sampler sampler(solid, shape);
  GridData data;
  data.corners.resize(shape.cornerCount());
  const Vector3i corner_counts = shape.bricks.array() + 1;
  parallelFor(0, corner_counts.z(), [&](int z) {
    const double side = GridShape::kBrick * shape.cell;
    SignedSurface::Nearest last{};
    for (int y = 0; y < corner_counts.y(); ++y)
      for (int x = 0; x < corner_counts.x(); ++x) {
        const Vector3d p = shape.origin + side * Vector3d(x, y, z);
        last = x == 0 ? sampler.surface().nearest(p) : sampler.surface().next(p, last, side);
        data.corners[shape.cornerIndex({x, y, z})] = static_cast<float>(last.distance);
      }
  });

  data.slots.assign(bricks, SparseGrid::kFar);
  parallelFor(0, shape.bricks.z(), [&](int z) {
    for (int y = 0; y < shape.bricks.y(); ++y)
      for (int x = 0; x < shape.bricks.x(); ++x) {
        const Vector3i b(x, y, z);
        if (needsSamples(sampler, shape, data.corners, b)) data.slots[shape.brickIndex(b)] = 0;
      }
  });
  std::vector<Vector3i> sampled;
  double largest = 0.0;
  for (Vector3i b(0, 0, 0); b.z() < shape.bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < shape.bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < shape.bricks.x(); ++b.x()) {
        std::int32_t& slot = data.slots[shape.brickIndex(b)];
        if (slot == SparseGrid::kFar) continue;
        slot = static_cast<std::int32_t>(sampled.size());
        sampled.push_back(b);
        largest = std::max(largest, largestSample(shape, data.corners, b));
      }
  const bool in_steps = options.sample_bits == 16;
  const std::size_t samples = sampled.size() * GridShape::kSamples;
  const std::size_t bytes = coarse_bytes + samples * (in_steps ? sizeof(std::int16_t) : sizeof(float));
  if (bytes > options.max_bytes) refuse(bytes);

  if (in_steps) shape.step = GridShape::stepFor(largest);
  in_steps ? data.steps.resize(samples) : data.samples.resize(samples);
  ProgressCounter counter(progress, sampled.size());
  parallelFor(std::size_t{0}, sampled.size(), [&](std::size_t i) {
    const std::size_t first = i * GridShape::kSamples;
    if (in_steps) {
      std::array<float, GridShape::kSamples> metres;
      sampler.fill(sampled[i], metres.data());
      std::transform(metres.begin(), metres.end(), data.steps.begin() + std::ptrdiff_t(first),
                     [&](float metres) { return shape.inSteps(metres); });
    } else {
      sampler.fill(sampled[i], data.samples.data() + first);
    }
    counter.add();
  });
  return std::make_shared<const SparseGrid>(shape, std::move(data));
}

/// The caps that matter to a field with this error bound [m]; null if none does.
std::shared_ptr<const OpeningCaps> wideCaps(const Openings& openings, double error) {
  TriangleMesh caps;
  std::vector<double> reach;
  for (std::size_t i = 0; i < openings.reach.size(); ++i) {
    if (openings.reach[i] <= error) continue;
    for (int k = 0; k < 3; ++k) caps.vertices.push_back(openings.caps.vertices[openings.caps.triangles[i][k]]);
    const int last = static_cast<int>(caps.vertices.size());
    caps.triangles.emplace_back(last - 3, last - 2, last - 1);
    reach.push_back(openings.reach[i]);
  }
  if (reach.empty()) return nullptr;
  return std::make_shared<const OpeningCaps>(std::move(caps), std::move(reach));
}

/// The field of a solid, and what of its openings matters there.
DistanceField build(const Solid& solid, const Openings& openings, const FieldOptions& options,
                    const Progress& progress) {
  if (options.max_error) {
    std::shared_ptr<const AdaptiveGrid> grid = buildAdaptive(solid, options, progress);
    const double error = grid->shape().error_bound;
    return DistanceField(std::move(grid), wideCaps(openings, error));
  }
  std::shared_ptr<const SparseGrid> grid = buildUniform(solid, options, progress);
  const double error = grid->errorBound();
  return DistanceField(std::move(grid), wideCaps(openings, error));
}

}  // namespace

DistanceField buildField(const TriangleMesh& mesh, const FieldOptions& options, const Progress& progress) {
  validate(mesh);
  validate(options);
  return buildField(Solid(mesh), options, progress);
}

DistanceField buildField(const Solid& solid, const FieldOptions& options, const Progress& progress) {
  validate(options);
  const Openings openings = solid.closed() ? Openings() : findOpenings(solid.boundary());
  if (openings.reach.empty()) return build(solid, openings, options, progress);
  return build(Solid(welded(merged(solid.boundary(), openings.caps))), openings, options, progress);
}

}  // namespace sdf_ccd
