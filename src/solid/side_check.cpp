#include "side_check.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/cancel_point.h"

namespace sdf_ccd {

SideCheck::SideCheck(const TriangleMesh& mesh) : mesh_(mesh), tree_(mesh) {
  const AlignedBox3d box = boundingBox(mesh);
  cell_ = box.sizes().maxCoeff() / kCells;
  counts_ = (box.sizes() / cell_).array().ceil().max(1.0).cast<int>();
  origin_ = box.center() - 0.5 * cell_ * counts_.cast<double>();
  winding_.resize(std::size_t(counts_.prod()));
  forEachPoint(counts_, [&](const Vector3i& c) {
    checkCancelled();
    winding_[index(c)] = tree_.windingNumber(center(c));
  });
}

std::vector<Vector3i> SideCheck::missing(Openings& openings) const {
  const TriangleTree closed(merged(mesh_, openings.caps));
  std::vector<Vector3i> missing;
  int inside = 0, wrong = 0;
  forEachPoint(counts_, [&](const Vector3i& c) {
    checkCancelled();
    // Cells next to a surface are skipped: their side depends on that surface alone.
    if (closed.closestPoint(center(c), 0.1 * cell_).triangle >= 0) return;
    const double alone = std::abs(winding_[index(c)]);
    const bool closed_inside = std::abs(closed.windingNumber(center(c))) > 0.5;
    const bool clear = alone < 0.1 || alone > 0.9;
    inside += closed_inside || alone > 0.9;
    if (!clear || closed_inside == (alone > 0.5)) return;
    ++wrong;
    if (!closed_inside) missing.push_back(c);
  });
  openings.doubt = inside > 0 ? double(wrong) / inside : 0.0;
  return missing;
}

void SideCheck::addVoxels(const std::vector<Vector3i>& cells, Openings& openings) const {
  openings.voxels = static_cast<int>(cells.size());
  std::vector<char> taken(winding_.size(), 0);
  for (const Vector3i& c : cells) taken[index(c)] = 1;
  std::map<std::array<int, 3>, int> corners;
  const auto corner = [&](const Vector3i& c) {
    const auto [entry, is_new] =
        corners.try_emplace({c.x(), c.y(), c.z()}, static_cast<int>(openings.caps.vertices.size()));
    if (is_new) openings.caps.vertices.push_back(origin_ + cell_ * c.cast<double>());
    return entry->second;
  };
  for (const Vector3i& c : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Vector3i neighbour = c;
        neighbour[axis] += side;
        const bool within = (neighbour.array() >= 0).all() && (neighbour.array() < counts_.array()).all();
        if (within && taken[index(neighbour)]) continue;
        const Vector3i u = Vector3i::Unit((axis + 1) % 3), v = Vector3i::Unit((axis + 2) % 3);
        const Vector3i low = c + (side > 0 ? Vector3i(Vector3i::Unit(axis)) : Vector3i(Vector3i::Zero()));
        std::array<int, 4> face = {corner(low), corner(low + u), corner(low + u + v), corner(low + v)};
        if (side < 0) std::swap(face[1], face[3]);
        openings.caps.triangles.emplace_back(face[0], face[1], face[2]);
        openings.caps.triangles.emplace_back(face[0], face[2], face[3]);
      }
    }
  }
}

}  // namespace sdf_ccd
