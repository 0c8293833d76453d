#pragma once

#include <cstdint>
#include <vector>

#include "geometry/box_tree.h"
#include "lanes/triangle_pairs.h"
#include "sdf_ccd/motion/chords.h"

/// Whether two surfaces of triangles stay apart while both move, and how far (design §3.17).
namespace sdf_ccd {

struct SeparationOptions {
  double margin = 0.0;       ///< surfaces count as apart where they surely are farther apart than this [m]
  double resolution = 5e-5;  ///< what comes nearer than this beyond the margin may stay open [m]
  int max_tests = 20000;     ///< of pairs of triangles; what is not decided by then stays open
};

/// What one query leaves for the next about the same two surfaces: where to look first. It never changes what is true.
struct SeparationWitness {
  int near_a = -1, near_b = -1;    ///< triangles that were nearest to each other
  int cross_a = -1, cross_b = -1;  ///< that crossed
};

enum class SeparationState {
  kApart,     ///< all along, by more than the margin
  kCrossing,  ///< at some time for sure, wherever they are displaced by the margin
  kOpen,
};

struct Separation {
  SeparationState state = SeparationState::kOpen;
  double distance = 0.0;            ///< where apart: a lower bound all along, the margin not taken off [m]
  double s = 0.0;                   ///< where crossing: when, from 0 to 1
  Vector3d p_A = Vector3d::Zero();  ///< and where: on the surface of one, and the other one has it, to rounding [m]
  Vector3d normal_A = Vector3d::UnitZ();  ///< of a triangle there, unit; either side
  int tests = 0;                          ///< that it took, of SeparationOptions::max_tests
  bool is_near = false;  ///< where open: some time they are no farther apart than the margin and twice the resolution
};

/// What a query needs while it runs.
struct SeparationMemory {
  struct Boxes {
    BoxTree::Slot a, b;
    float gap;
  };
  struct Triangles {
    std::int32_t a, b;
  };
  std::vector<Boxes> stack;
  std::vector<Triangles> near;  ///< not known to be apart
  TrianglePairs filter, exact;
  std::array<Triangles, TrianglePairs::kSize> filter_ids, exact_ids;
  TrianglePairs single;
};

/// Follows B against A through a motion in which each moves with a constant twist in the world, s from 0 to 1.
///
/// The proof of kApart. A point p of B is at q(s) = X_AB(s) p, and its acceleration in A's frame is no more than a. So
/// over an interval of length h it is nowhere farther than e = a h²/8 from the chord between its places at both ends.
///  - Two triangles: with n a unit vector, and g the least of n·q(s) − n·x at both ends over all corners q of B and x
///  of
///    A, all points of the triangles are at least g − e apart at all times between, as chords and triangles are convex.
///  - Two boxes: they are tested halfway, at the pose with the rotation R between both ends' and the place of B's
///    origin o on the middle of its chord. B's chords pass their middles at M p + ..., M = (R_0 + R_1)/2, which is
///    within |M − R| |p − o| of that pose, and reach Δ(p) = (X_1 p − X_0 p)/2 to either side, of which along n only
///    n·Δ(p) matters. Within a box of reach ρ about c, |Δ(p) − Δ(c)| ≤ sin(θ/2) ρ, with θ the angle between R_0 and
///    R_1: a difference of rotations has the singular values 2 sin(θ/2), twice, and 0, so that is its Frobenius norm
///    over √8.
///  - Every pair of triangles is in one pair of boxes, or one of triangles, whose gap was found to be above the margin;
///    else the interval is halved, for these pairs alone, until it is. `distance` is the least of all gaps.
/// What rounding takes off: kBoxRounding, and 32 ε of the coordinates for triangles, as placing a corner takes four
/// roundings of coordinates of A's frame each way (√3 · 4), a product of it with n three, and n's length two.
///
/// What is_near says. Triangles are left open where the gap by the direction n of their closest points, with B's
/// corners on the middles of their chords, is no more than the margin, and these corners go no farther than m over the
/// interval, m + e ≤ resolution. With d the distance of those closest points, n·q − n·x is at least d − m/2 at both
/// ends, so d ≤ margin + e + m/2; and halfway in time B is within e of these middles: the distance is then no more than
/// margin + 2e + m/2 ≤ margin + 2 resolution.
///
/// The proof of kCrossing: an edge pierces a triangle at a time (see crossingPoint()), or rounded triangles overlap.
///
/// A branch is cut where its gap is above 0.6 of that of the nearest triangles known. Before all that, one plane
/// through the nearest triangles of the last query may separate the surfaces as a whole.
/// @param motion  frame F is A's, P is B's; rotations to rounding, else the margin holds what they are off by.
Separation separation(const BoxTree& a, const BoxTree& b, const TwoBodyMotion& motion, const SeparationOptions& options,
                      SeparationWitness& witness, SeparationMemory& memory);

}  // namespace sdf_ccd
