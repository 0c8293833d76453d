#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd::benchmark {

enum class Find { kFirst, kAll, kAny };

/// What is asked of a segment.
struct Question {
  Find find = Find::kFirst;
  double sigma = 0.0;  ///< isovalue [m]
};

/// A library, or a way to use it, that finds where segments cross a surface; ready to be asked.
class SegmentSystem {
 public:
  virtual ~SegmentSystem() = default;
  virtual std::string name() const = 0;
  virtual bool answers(const Question& question) const { return question.sigma == 0.0; }

  /// Of what it built over the mesh [bytes]; 0 where it does not say.
  virtual std::size_t bytes() const = 0;

  /// True for a system that takes many segments in one call and is best given all at once.
  virtual bool batched() const { return false; }

  /// Answers all segments, one thread.
  /// @return kAll: crossings of the surface within the segments; else: segments with a contact. A field counts a
  ///         segment that starts inside as in contact, a mesh only sees one that crosses.
  virtual long run(const Segment* segments, std::size_t count, const Question& question) = 0;

  /// True for a system that also says when: see firstTimes().
  virtual bool tellsTimes() const { return false; }

  /// Parameters in [0, 1] of first hits of the surface, one thread; negative where there is none.
  virtual void firstTimes(const std::vector<Segment>& segments, std::vector<double>& times) {
    times.assign(segments.size(), -1.0);
  }
};

using SegmentSystems = std::vector<std::unique_ptr<SegmentSystem>>;

/// A field as a subject of the study.
struct FieldSubject {
  const TriangleMesh& mesh;
  const DistanceField& field;
  int cells;   ///< along the longest side; 0 for a field built to a maximum error
  bool paper;  ///< true if the paper's dense grids are wanted
};

/// Every system is one file that adds itself here before main(): those that need only the mesh, and those that need
/// a field or a resolution. Either may add nothing.
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
