#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Resets the result, but keeps its span and its allocated memory.
void clear(PairResult& result);

/// @throws std::runtime_error if an error bound is not finite.
void requireFinite(const ErrorSources& error);

/// Sets CLEAR. @param clearance  lower bound of the distance at the span's end, for the bodies at the given poses [m].
void setClear(double clearance, PairResult& result);

/// Sets the result of a pair that is clear without a test.
void setSkipped(const ErrorSources& error, PairResult& result);

/// Whether the pair's intervals and wrenches are known: they are not if an incomplete contact is only proved.
bool isTimed(const PairResult& pair);

void setWrenchesUnknown(PairResult& result);

/// Whether a point is deepest within the interval.
bool isWithin(const ContactPoint& point, const Interval& interval);

/// Of two points of the same depth, the one whose error is larger may be deeper.
bool isDeeper(const ContactPoint& a, const ContactPoint& b);

/// The deepest of the peaks that are within the interval, and of these and the deepest point of all; null if there is
/// none.
const ContactPoint* deepestPeak(const PairResult& pair, const Interval& interval);
const ContactPoint* deepestWithin(const PairResult& pair, const Interval& interval);

/// Sets the point's interval to the one that contains its time; adds an interval of zero length if none does.
void setTimes(std::vector<Interval>& intervals, ContactPoint& point);

void setNotChecked(const std::string& reason, PairResult& result);

/// Whether the interval contains one of the samples, which increase.
bool holdsSample(const Interval& interval, const std::vector<double>& samples);

}  // namespace sdf_ccd
