#pragma once

#include <cstdint>
#include <vector>

#include "geometry/box_tree.h"
#include "lanes/triangle_pairs.h"
#include "sdf_ccd/motion/chords.h"

/// Whether two surfaces of triangles stay apart while both move, and how far (design §3.17).
namespace sdf_ccd {

struct SeparationOptions {
  double margin = 0.0;       ///< surfaces count as apart if their distance surely exceeds this [m]
  double resolution = 5e-5;  ///< surfaces closer than this beyond the margin may remain undecided [m]
  int max_tests = 20000;     ///< upper bound of the triangle pairs tested; undecided pairs then remain open
};

/// What one query stores for the next one about the same two surfaces: where to start. It never affects the truth.
struct SeparationWitness {
  int near_a = -1, near_b = -1;    ///< the triangles that were nearest to each other
  int cross_a = -1, cross_b = -1;  ///< that crossed
};

enum class SeparationState {
  kApart,     ///< over the whole motion, by more than the margin
  kCrossing,  ///< at some time, even if displaced by up to the margin
  kOpen,
};

struct Separation {
  SeparationState state = SeparationState::kOpen;
  double distance = 0.0;            ///< if apart: a lower bound over the whole motion, the margin not subtracted [m]
  double s = 0.0;                   ///< if crossing: the time, from 0 to 1
  Vector3d p_A = Vector3d::Zero();  ///< the position: on the surface of one, inside or on the other, up to rounding [m]
  Vector3d normal_A = Vector3d::UnitZ();  ///< of a triangle there, unit; either side
  int tests = 0;                          ///< number of triangle pairs tested, at most SeparationOptions::max_tests
  bool is_near = false;  ///< if open: at some time their distance is at most the margin plus twice the resolution
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
  std::vector<Boxes> stack;
  std::vector<Triangles> near;  ///< pairs not known to be apart
  TrianglePairs filter, exact;
  std::array<Triangles, TrianglePairs::kSize> filter_ids, exact_ids;
  TrianglePairs single;
};

/// Tests B against A over a motion in which each moves with a constant twist in the world, s from 0 to 1.
///
/// The proof of kApart. A point p of B is at q(s) = X_AB(s) p, and its acceleration in A's frame is no more than a. So
/// over an interval of length h it is within e = a h²/8 of the chord between its positions at both ends.
///  - Two triangles: with n a unit vector, and g the least of n·q(s) − n·x at both ends over all corners q of B and x
///  of
///    A, all points of the triangles are at least g − e apart at all times between, as chords and triangles are convex.
///  - Two boxes: they are tested halfway, at the pose with the rotation R between both ends' and with B's
///    origin o on the middle of its chord. B's chords pass their middles at M p + ..., M = (R_0 + R_1)/2, which is
///    within |M − R| |p − o| of that pose, and extend Δ(p) = (X_1 p − X_0 p)/2 to either side, of which along n only
///    n·Δ(p) matters. Within a box of reach ρ about c, |Δ(p) − Δ(c)| ≤ sin(θ/2) ρ, with θ the angle between R_0 and
///    R_1: a difference of rotations has the singular values 2 sin(θ/2), twice, and 0, so that is its Frobenius norm
///    over √8.
///  - Every pair of triangles is in one pair of boxes, or one of triangles, whose gap was found to be above the margin;
///    else the interval is halved, for these pairs alone, until it is. `distance` is the least of all gaps.
/// Subtracted for rounding: kBoxRounding, and 32 ε of the coordinates for triangles: transforming a corner takes four
/// roundings of coordinates of A's frame per direction (√3 · 4), its dot product with n three, and n's length two.
///
/// Why is_near holds. Triangles are left open where the gap along the direction n of their closest points, with B's
/// corners on the middles of their chords, is no more than the margin, and these corners go no farther than m over the
/// interval, m + e ≤ resolution. With d the distance of those closest points, n·q − n·x is at least d − m/2 at both
/// ends, so d ≤ margin + e + m/2; and halfway in time B is within e of these middles: the distance is then no more than
/// margin + 2e + m/2 ≤ margin + 2 resolution.
///
/// The proof of kCrossing: an edge pierces a triangle at a time (see crossingPoint()), or rounded triangles overlap.
///
/// A branch is pruned if its gap exceeds 0.6 times that of the nearest triangles known. Before the descent, one plane
/// through the nearest triangles of the last query may separate the surfaces as a whole.
/// @param motion  frame F is A's, P is B's; the margin must cover what rotations deviate from orthonormal ones.
Separation separation(const BoxTree& a, const BoxTree& b, const TwoBodyMotion& motion, const SeparationOptions& options,
                      SeparationWitness& witness, SeparationMemory& memory);

}  // namespace sdf_ccd
