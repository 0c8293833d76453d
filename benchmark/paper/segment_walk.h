#pragma once

#include <vector>

#include "dense_field.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::benchmark {

/// The paper's segment query as published (Xu & Barbič 2014, §3.1-3.2), for comparison: a digital differential
/// analyser over the cells, a sign test of the eight samples and of the values where the segment enters and leaves a
/// cell, and at most five steps of Eq. (2). Two crossings within one cell are lost, and times keep an error.
/// @param octree  null for the traversal of all cells; else the largest block without the isosurface is skipped;
///                it is searched from the root at every new cell.
/// @param first_only  stop at the first entry of the list.
/// @param times  replaced by the paper's list: ends of the intervals in which φ ≤ σ, increasing, an even number of
///               them (unless first_only), 0 or 1 where the segment starts or ends inside.
void paperIntervals(const DenseField& field, const MinMaxOctree* octree, const Segment& segment, double sigma,
                    bool first_only, std::vector<double>& times);

}  // namespace sdf_ccd::benchmark
