#pragma once

#include <cstdint>
#include <vector>

#include "common/infinity.h"
#include "motion/chords.h"
#include "surface/box_tree.h"
#include "surface/triangle_pairs.h"

/// Whether two surfaces of triangles stay apart while both move, and how far (design §3.17).
namespace sdf_ccd {

struct SeparationOptions {
  double margin = 0.0;       ///< surfaces count as apart if their distance surely exceeds this [m]
  double resolution = 5e-5;  ///< surfaces closer than this beyond the margin may remain undecided [m]
  int max_tests = 20000;     ///< upper bound of the triangle pairs tested; undecided pairs then remain open
};

/// Stored by one query for the next of the same two surfaces: where to start. Results are correct for any witness.
struct SeparationWitness {
  int near_a = -1, near_b = -1;    ///< the triangles that were nearest to each other
  int cross_a = -1, cross_b = -1;  ///< the triangles that crossed
};

enum class SeparationState {
  kApart,     ///< over the whole motion, by more than the margin
  kCrossing,  ///< at some time, even if the surfaces are displaced by up to the margin
  kOpen,      ///< neither is proved
};

struct Separation {
  SeparationState state = SeparationState::kOpen;
  double distance = 0.0;            ///< if apart: a lower bound over the whole motion, the margin not subtracted [m]
  double s = 0.0;                   ///< if crossing: the time, from 0 to 1
  Vector3d p_A = Vector3d::Zero();  ///< if crossing: a point on one surface, in or on the other, up to rounding [m]
  Vector3d normal_A = Vector3d::UnitZ();  ///< unit normal of a triangle there; its sign is arbitrary
  int tests = 0;  ///< number of triangle pairs tested; may exceed SeparationOptions::max_tests by the last groups
  /// If open: at some time their distance is at most this beyond the margin [m], which is twice the resolution;
  /// infinite if that is not known.
  double open_within = kInfinity;
};

/// The memory of a running query.
struct SeparationMemory {
  struct Boxes {
    BoxTree::Slot a, b;
    float gap;
  };
  struct Triangles {
    std::int32_t a, b;
  };
  /// A node of a single tree, with a lower bound of its boxes' heights.
  struct HighBox {
    double height;
    std::int32_t node;
  };
  std::vector<Boxes> stack;
  std::vector<HighBox> high_boxes;
  std::vector<Triangles> near;  ///< pairs not known to be apart
  TrianglePairs filter, exact;
  std::array<Triangles, TrianglePairs::kSize> filter_ids, exact_ids;
  TrianglePairs single;
};

/// Tests B against A over a motion in which each moves with a constant twist in the world, s from 0 to 1.
///
/// The proof of kApart. A point p of B is at q(s) = X_AB(s) p, and its acceleration in A's frame is at most a. So over
/// an interval of length h it is within e = a h²/8 of the chord between its positions at both ends.
///  - Two triangles: let n be a unit vector, and g the minimum of n·q(s) − n·x at both ends, over all corners q of
///    B and x of A. All points of the triangles are at least g − e apart at all times between, as chords and
///    triangles are convex.
///  - Two boxes: they are tested at the pose halfway, whose rotation R is halfway between those at both ends and which
///    has B's origin o in the middle of its chord. The middles of B's chords are M p + ..., M = (R_0 + R_1)/2, within
///    |M − R| |p − o| of that pose. The chords extend by Δ(p) = (X_1 p − X_0 p)/2 to either side, of which only
///    n·Δ(p) matters along n. Within a box of reach ρ about c, |Δ(p) − Δ(c)| ≤ sin(θ/2) ρ, with θ the angle
///    between R_0 and R_1: the singular values of the difference of two rotations are 2 sin(θ/2), twice, and 0, so
///    sin(θ/2) is its Frobenius norm over √8. In a long search, that bound is taken along each direction by itself:
///    with D = (R_1 − R_0)/2 and the box c ± h_1 a_1 ± h_2 a_2 ± h_3 a_3, |n·(Δ(p) − Δ(c))| ≤ Σ |n·D a_k| h_k, which
///    vanishes for a rotation about n.
///  - A plane between the surfaces as wholes: Δ(p) along its normal n is n·Δ(o) + w·(p − o), with w = Dᵀ n, and
///    likewise n·(M − R)(p − o).
///  - A box and a single triangle: at that same pose, with n the direction from the triangle's closest point to the
///    box's center, less the box's reach ρ.
///  - Every pair of triangles is covered by a pair of boxes, or a pair of triangles, whose gap was found to exceed the
///    margin; otherwise the interval is halved, for the remaining pairs only, until it does. `distance` is the smallest
///    of all these gaps.
/// Subtracted for rounding: kBoxRounding, and 32 ε of the coordinates for triangles: transforming a corner takes four
/// roundings of coordinates of A's frame per axis (√3 · 4), its dot product with n three, and n's length two.
///
/// Why open_within holds. Triangles are left open if the gap along the direction n of their closest points, with B's
/// corners at the middles of their chords, is at most the margin, and these corners move by at most m over the
/// interval, with m + e ≤ resolution. With d the distance of those closest points, n·q − n·x is at least
/// d − m/2 at both ends, so d ≤ margin + e + m/2. Halfway in time B is within e of these middles: the distance is
/// then at most margin + 2e + m/2 ≤ margin + 2 resolution.
///
/// The proof of kCrossing: an edge pierces a triangle at a time (see crossingPoint()), or rounded triangles overlap.
///
/// A branch is pruned if its gap exceeds 0.4 times that of the nearest known triangles. Before the descent, one plane
/// between the nearest triangles of the last query is tested, which may separate the surfaces as a whole; in a long
/// search, also one between their convex hulls (hull_direction.h). The interval is also halved where chords deviate
/// from the paths by much, compared with the nearest known triangles.
/// @param motion  frame F is A's, P is B's; the margin must cover the deviation of rotations from orthonormal ones.
Separation separation(const BoxTree& a, const BoxTree& b, const TwoBodyMotion& motion, const SeparationOptions& options,
                      SeparationWitness& witness, SeparationMemory& memory);

}  // namespace sdf_ccd
