#pragma once

#include <vector>

#include "adversarial/duel.h"

/// Bodies as people draw them: hollow, inside out, of membranes, without a lid.
namespace sdf_ccd::test {

Actor hollowBox();    ///< with a cavity that nothing leads into
Actor nestedBoxes();  ///< the same, but with the inner box drawn outward too: what is within may be solid
Actor invertedBox();
Actor bowTie();          ///< two prisms that share an edge, the small one inside out
Actor overlaidLobe();    ///< of a surface that crosses itself, the one inside out, with a block over it
Actor coveredBlock();    ///< half within a bin that is turned over, whose faces look inward
Actor membrane();        ///< one square, drawn from one side
Actor doubleMembrane();  ///< drawn from both
Actor wheel();           ///< an open rim, with a web drawn from both sides whose border lies on the rim's triangles
Actor openBin();         ///< five walls without thickness, no lid
Actor paddedBin();       ///< the same in two parts: with a pad on its floor, which is a box
Actor thickBin();        ///< a closed mesh
Actor sharedEdge();      ///< two boxes of one mesh with an edge in common
Actor sharedFace();      ///< two boxes of one mesh, each with a wall where they meet
Actor overlapping();     ///< two boxes of one mesh that overlap
Actor fins();            ///< three squares that share an edge
Actor voxel();           ///< 5 cm; only a field
Actor voxels();          ///< three of them, in an L
Actor clusters();        ///< two voxels, far from each other; only a field
Actor beads();           ///< two beads of one mesh, far from each other
Actor ground();          ///< a half-space
Actor groundAndPost();   ///< a half-space and a small box far above it in one body; only a field
Actor mapAndPost();      ///< a voxel and a small box in one body; only a field
Actor groove();          ///< two half-spaces, with a right angle between them; only a field
Actor sleeve();          ///< a mesh, a box half in it and another one wholly in it, in three parts
Actor link();            ///< 40 cm, a mesh
Actor bead();            ///< 2 cm
Actor rod();

std::vector<Actor> drawnActors();

}  // namespace sdf_ccd::test
