#include <algorithm>
#include <array>

#include "adversarial/drawn.h"
#include "adversarial/duel.h"
#include "oracle/shapes.h"

/// The family `parts`: boxes of one mesh beside, inside and overlapping each other, each tessellated independently,
/// some inside out, some with a loose sheet. A bead is checked in every cell of the lattice on which the boxes lie.
namespace sdf_ccd::test {
namespace {

constexpr int kCells = 4;      // lattice cells along each axis
constexpr double kCell = 0.1;  // [m]

struct LatticeBox {
  Vector3i low = Vector3i::Zero(), high = Vector3i::Zero();
  bool inside_out = false;

  bool holds(const Vector3i& cell) const {
    return (cell.array() >= low.array()).all() && (cell.array() < high.array()).all();
  }
  bool holdsStrictly(const LatticeBox& other) const {
    return (other.low.array() > low.array()).all() && (other.high.array() < high.array()).all();
  }
  bool meets(const LatticeBox& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

enum class Truth { kSolid, kEmpty, kOpinion };

/// Random boxes, and whether each cell is solid, empty or ambiguous (kOpinion). A box that is inside out is a cavity or
/// a mistake. It can be a cavity only if the other boxes cover all of it, and certainly is one if it lies strictly
/// inside a single box and touches no other. If all boxes that are not covered by others are inside out, the whole file
/// may be.
class Drawing {
 public:
  explicit Drawing(Random& random) : boxes_(2 + random() % 3) {
    for (LatticeBox& box : boxes_) {
      for (int k = 0; k < 3; ++k) {
        box.low[k] = static_cast<int>(random() % kCells);
        box.high[k] = box.low[k] + 1 + static_cast<int>(random() % (kCells - box.low[k]));
      }
    }
    // Some faces of the last box are flush with faces of the first.
    for (int k = 0; k < 3; ++k) {
      LatticeBox& last = boxes_.back();
      const bool low = random() % 4 == 0, high = random() % 4 == 0;
      if (low) last.low[k] = boxes_[0].low[k];
      if (high) last.high[k] = boxes_[0].high[k];
      last.high[k] = std::max(last.high[k], last.low[k] + 1);
    }
    for (std::size_t i = random() % 3; i > 0; --i) boxes_[random() % boxes_.size()].inside_out = true;
    for (std::size_t i = 0; i < boxes_.size(); ++i) is_held_.push_back(isHeld(i));
    for (std::size_t i = 0; i < boxes_.size(); ++i) may_be_inside_out_ &= is_held_[i] || boxes_[i].inside_out;
  }

  const std::vector<LatticeBox>& boxes() const { return boxes_; }

  Truth at(const Vector3i& cell) const {
    Truth truth = reading(cell, false);
    if (may_be_inside_out_ && reading(cell, true) != truth) truth = Truth::kOpinion;
    return truth;
  }

 private:
  /// @param is_turned  whether the whole file is taken as inside out.
  Truth reading(const Vector3i& cell, bool is_turned) const {
    bool solid = false, perhaps_cavity = false, surely_cavity = false;
    int around = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (!boxes_[i].holds(cell)) continue;
      ++around;
      const bool inward = boxes_[i].inside_out != is_turned;
      solid = solid || !inward || !is_held_[i];
      perhaps_cavity = perhaps_cavity || (inward && is_held_[i]);
      surely_cavity = surely_cavity || (inward && isSurelyCavity(i, is_turned));
    }
    if (around == 0 || (around == 2 && surely_cavity)) return Truth::kEmpty;
    return solid && !perhaps_cavity ? Truth::kSolid : Truth::kOpinion;
  }

  bool isHeld(std::size_t inner) const {
    const LatticeBox& box = boxes_[inner];
    Vector3i cell;
    for (cell[0] = box.low[0]; cell[0] < box.high[0]; ++cell[0])
      for (cell[1] = box.low[1]; cell[1] < box.high[1]; ++cell[1])
        for (cell[2] = box.low[2]; cell[2] < box.high[2]; ++cell[2]) {
          bool held = false;
          for (std::size_t i = 0; i < boxes_.size(); ++i) held = held || (i != inner && boxes_[i].holds(cell));
          if (!held) return false;
        }
    return true;
  }

  bool isSurelyCavity(std::size_t inner, bool is_turned) const {
    int holders = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (i == inner) continue;
      const bool outward = boxes_[i].inside_out == is_turned;
      const bool holds = outward && boxes_[i].holdsStrictly(boxes_[inner]);
      if (!holds && boxes_[i].meets(boxes_[inner])) return false;
      holders += holds;
    }
    return holders == 1;
  }

  std::vector<LatticeBox> boxes_;
  std::vector<char> is_held_;  // per box
  bool may_be_inside_out_ = true;
};

/// Tessellates each face as a separate grid with random diagonals.
TriangleMesh tessellatedApart(const LatticeBox& box, Random& random) {
  TriangleMesh mesh;
  const bool by_cells = random() % 3 == 0;
  for (int face = 0; face < 6; ++face) {
    const int axis = face % 3, across = (axis + 1) % 3, up = (axis + 2) % 3;
    const bool is_high = face >= 3;
    std::array<int, 2> steps;
    for (int k = 0; k < 2; ++k) {
      const int along = k == 0 ? across : up;
      steps[k] = by_cells ? box.high[along] - box.low[along] : 1 + static_cast<int>(random() % 6);
    }
    const auto at = [&](int i, int k) {
      Vector3d p;
      p[axis] = (is_high ? box.high : box.low)[axis];
      p[across] = box.low[across] + double(i) * (box.high[across] - box.low[across]) / steps[0];
      p[up] = box.low[up] + double(k) * (box.high[up] - box.low[up]) / steps[1];
      return Vector3d(kCell * p);
    };
    for (int i = 0; i < steps[0]; ++i) {
      for (int k = 0; k < steps[1]; ++k) {
        const int first = static_cast<int>(mesh.vertices.size()), turn = static_cast<int>(random() % 2);
        mesh.vertices.insert(mesh.vertices.end(), {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
        const auto corner = [&](int c) { return first + (is_high ? c + turn : 7 - c - turn) % 4; };
        mesh.triangles.emplace_back(corner(0), corner(1), corner(2));
        mesh.triangles.emplace_back(corner(0), corner(2), corner(3));
      }
    }
  }
  return box.inside_out ? flipped(mesh) : mesh;
}

/// The mesh as a file may hold it: triangles in random order, at a pose, in doubles or floats, with or without a loose
/// sheet.
TriangleMesh meshOf(const Drawing& drawing, const Isometry3d& X_WM, Random& random) {
  TriangleMesh mesh;
  for (const LatticeBox& box : drawing.boxes()) mesh = merged(std::move(mesh), tessellatedApart(box, random));
  if (random() % 2 == 0) {
    const double beside = kCell * (kCells + 2);
    mesh = merged(std::move(mesh), TriangleMesh{{{beside, 0, 0}, {beside, kCell, 0}, {beside, 0, kCell}}, {{0, 1, 2}}});
  }
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  const bool has_floats = random() % 2 != 0;
  for (Vector3d& v : mesh.vertices) {
    v = X_WM * v;
    if (has_floats) v = v.cast<float>().cast<double>();
  }
  return mesh;
}

/// Checks a bead that moves within one cell.
void play(Duel& duel, const Isometry3d& X_WM, const Vector3i& cell, Truth truth, Tally& tally) {
  Isometry3d X_WB = X_WM;
  X_WB.translation() = X_WM * (kCell * (cell.cast<double>() + Vector3d::Constant(0.5)));
  Isometry3d X_next = X_WB;
  X_next.translation() += X_WM.linear() * Vector3d(0.1 * kCell, 0.0, 0.0);
  duel.monitor().reset();
  const Isometry3d still = Isometry3d::Identity();
  const PairResult& result = duel.follow(pairCycle({still, still}, {X_WB, X_next}));
  ++tally.cases;
  tally.clear += result.verdict == Verdict::kClear;
  tally.contact += result.verdict == Verdict::kContact;
  tally.uncertain += result.verdict == Verdict::kUncertain;
  tally.not_checked += result.verdict == Verdict::kNotChecked;
  if (truth == Truth::kSolid && result.verdict == Verdict::kClear) {
    ++tally.false_clear;
    tally.fail("CLEAR", "in a part");
  }
  if (truth == Truth::kEmpty && result.verdict == Verdict::kContact) {
    ++tally.false_contact;
    tally.fail("CONTACT", "in no part");
  }
}

}  // namespace

Tally parts(std::uint64_t seed, long cases) {
  Random random(seed);
  Tally tally;
  BodyOptions scene;
  scene.field.cells = 24;
  scene.shell.spacing = 0.5 * kCell;
  while (tally.cases < cases) {
    const Drawing drawing(random);
    const Isometry3d X_WM = random() % 2 ? pose(random, 3.0, 0.5) : Isometry3d::Identity();
    Actor mesh = convexActor("parts", boxMesh(Vector3d::Constant(kCell)));  // its solid is not used
    mesh.geometry[0].shape = std::make_shared<const TriangleMesh>(meshOf(drawing, X_WM, random));
    Actor bead = boxActor(Vector3d::Constant(0.1 * kCell));
    if (random() % 4 == 0) {
      bead = convexActor("voxel", boxMesh(Vector3d::Constant(0.1 * kCell)));
      bead.geometry[0].watertight_voxels = bead.is_field_only = true;
    }
    Duel duel(mesh, bead, scene, {});
    Vector3i cell;
    for (cell[0] = -1; cell[0] <= kCells; ++cell[0])
      for (cell[1] = -1; cell[1] <= kCells; ++cell[1])
        for (cell[2] = -1; cell[2] <= kCells; ++cell[2]) {
          const Truth truth = drawing.at(cell);
          const bool is_border = (cell.array() < 0).any() || (cell.array() == kCells).any();
          if (truth == Truth::kOpinion || (is_border && random() % 8 != 0)) continue;
          play(duel, X_WM, cell, truth, tally);
        }
  }
  return tally;
}

}  // namespace sdf_ccd::test
