#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measurement.h"
#include "peers.h"

/// Studies of error against run time. Each runs the same queries on every system at every setting, in turn, on one
/// thread, and compares the answers with exact values.
namespace sdf_ccd::precision {

struct StudyInput {
  TriangleMesh mesh;   ///< closed and oriented (see orientOutward())
  int queries = 2000;  ///< number of segments and points; of motions of bodies a twentieth to a fortieth
  bool quick = false;  ///< leave out the finest settings
  Peers peers;         ///< other libraries
  std::function<void(double)> progress = [](double) {};  ///< called with the fraction done
};

struct Study {
  const char* name;
  const char* description;  ///< one line
  StudyResult (*run)(const StudyInput&);
};

/// All studies, in the order in which to read them.
const std::vector<Study>& studies();

StudyResult cellStudy(const StudyInput& input);
StudyResult maxErrorStudy(const StudyInput& input);
StudyResult chordStudy(const StudyInput& input);
StudyResult spacingStudy(const StudyInput& input);
StudyResult quadratureStudy(const StudyInput& input);
StudyResult stepStudy(const StudyInput& input);

}  // namespace sdf_ccd::precision
