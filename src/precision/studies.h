#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measure.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/segments.h"

/// Studies of error against run time. Each runs the same queries on every system at every setting, in turn, on one
/// thread, and compares the answers with exact values.
namespace sdf_ccd::precision {

/// What the studies of fields query.
struct FieldQueries {
  const TriangleMesh& mesh;
  std::vector<Segment>
      segments;                  ///< for the parameters in [0, 1] at which they first meet the surface; negative if not
  std::vector<Vector3d> points;  ///< for their signed distances [m]
};

struct FieldSystems {
  std::vector<System<double>> hits, distances;
};

struct StudyInput {
  TriangleMesh mesh;   ///< closed and oriented (see orientOutward())
  int queries = 2000;  ///< number of segments and points; of motions of bodies a twentieth to a fortieth
  bool quick = false;  ///< leave out the finest settings
  /// Adds systems of other libraries to a study of fields: those with this number of cells along the longest side; with
  /// 0, those that use the mesh itself. The queries outlive them.
  std::function<void(const FieldQueries&, int cells, FieldSystems&)> add_peers = [](auto&&...) {};
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
StudyResult spacingStudy(const StudyInput& input);
StudyResult quadratureStudy(const StudyInput& input);
StudyResult stepStudy(const StudyInput& input);

}  // namespace sdf_ccd::precision
