#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::benchmark {

enum class Find { kFirst, kAll, kAny };

/// A query of a segment.
struct Question {
  Find find = Find::kFirst;
  double sigma = 0.0;  ///< isovalue [m]
};

/// A library, or one of its interfaces, that finds where segments cross a surface; built for one mesh.
class SegmentSystem {
 public:
  virtual ~SegmentSystem() = default;
  virtual std::string name() const = 0;
  virtual bool answers(const Question& question) const { return question.sigma == 0.0; }

  /// Memory of its data structures [bytes]; 0 if unknown.
  virtual std::size_t bytes() const = 0;

  /// Whether the system works best on all segments in one call.
  virtual bool batched() const { return false; }

  /// Queries all segments, on one thread.
  /// @return kAll: number of crossings of the surface; else: number of segments with a contact. For fields, a segment
  ///         that starts inside has a contact; for meshes, only one that crosses the surface.
  virtual long run(const Segment* segments, std::size_t count, const Question& question) = 0;

  /// Whether the system implements firstTimes().
  virtual bool tellsTimes() const { return false; }

  /// Computes the parameters in [0, 1] of the first hits, on one thread; negative for segments without one.
  virtual void firstTimes(const std::vector<Segment>& segments, std::vector<double>& times) {
    times.assign(segments.size(), -1.0);
  }
};

using SegmentSystems = std::vector<std::unique_ptr<SegmentSystem>>;

/// A mesh and its field, for which systems are built.
struct FieldSubject {
  const TriangleMesh& mesh;
  const DistanceField& field;
  int cells;   ///< along the longest side; 0 for a field built to a maximum error
  bool paper;  ///< whether to build the paper's dense grids
};

/// Factories of systems that need only the mesh, and of systems that need a field or a resolution. Each is in a file of
/// its own that registers it here before main(). A factory may add no system.
using MeshFactory = std::function<void(const TriangleMesh&, SegmentSystems&)>;
using FieldFactory = std::function<void(const FieldSubject&, SegmentSystems&)>;

inline std::vector<MeshFactory>& meshFactories() {
  static std::vector<MeshFactory> factories;
  return factories;
}
inline std::vector<FieldFactory>& fieldFactories() {
  static std::vector<FieldFactory> factories;
  return factories;
}

struct Registered {
  explicit Registered(MeshFactory factory) { meshFactories().push_back(std::move(factory)); }
  explicit Registered(FieldFactory factory) { fieldFactories().push_back(std::move(factory)); }
};

}  // namespace sdf_ccd::benchmark
