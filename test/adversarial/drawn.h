#pragma once

#include <vector>

#include "adversarial/duel.h"

/// Bodies with the shapes and defects of meshes found in practice: hollow, inside out, without thickness, open.
namespace sdf_ccd::test {

Actor hollowBox();    ///< with a closed cavity
Actor nestedBoxes();  ///< the same, but the inner box faces outward too: its inside may be solid
Actor invertedBox();
Actor bowTie();          ///< two prisms that share an edge, the small one inside out
Actor overlaidLobe();    ///< a self-intersecting surface; its inside-out lobe is covered by a block
Actor coveredBlock();    ///< a block, half inside an upturned bin whose faces face inward
Actor membrane();        ///< a square, faces on one side
Actor doubleMembrane();  ///< a square, faces on both sides
Actor wheel();           ///< an open rim, and a web with faces on both sides whose border lies on the rim's triangles
Actor openBin();         ///< five walls without thickness; no lid
Actor paddedBin();       ///< an open bin, and a box on its floor as a second part
Actor thickBin();        ///< a bin with walls of some thickness, as a closed mesh
Actor sharedEdge();      ///< two boxes in one mesh with a common edge
Actor sharedFace();      ///< two boxes in one mesh, each with a wall at the common face
Actor overlapping();     ///< two overlapping boxes in one mesh
Actor fins();            ///< three rectangles that share an edge
Actor voxel();           ///< a voxel of 5 cm; only a field
Actor voxels();          ///< three voxels in an L; only a field
Actor clusters();        ///< two voxels far apart; only a field
Actor beads();           ///< two beads far apart, in one mesh
Actor ground();          ///< a half-space
Actor groundAndPost();   ///< a half-space and a small box far above it in one body; only a field
Actor mapAndPost();      ///< a voxel and a small box in one body; only a field
Actor groove();          ///< two half-spaces at a right angle; only a field
Actor sleeve();          ///< three parts: a mesh, a box half inside it and a box wholly inside it
Actor link();            ///< a box of 40 cm, as a mesh
Actor bead();            ///< a ball of radius 2 cm, as a mesh
Actor rod();

std::vector<Actor> drawnActors();

}  // namespace sdf_ccd::test
