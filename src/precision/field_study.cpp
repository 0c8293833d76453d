/// The studies `cell` and `max-error`: fields against the exact mesh.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "common/number_text.h"
#include "exact_surface.h"
#include "random_inputs.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"
#include "studies.h"

namespace sdf_ccd::precision {
namespace {

constexpr double kDeepest = 0.005;  ///< maximum depth of the points [box sides]
constexpr double kFree = 0.06;      ///< minimum distance of starts [box sides], so that they are outside in any field

double sideOf(const TriangleMesh& mesh) {
  return boundingBox(mesh).sizes().maxCoeff();
}

/// Queries with their exact answers on a mesh.
struct ExactQueries : FieldQueries {
  std::vector<double> times, distances;

  /// @param input  its mesh outlives this.
  explicit ExactQueries(const StudyInput& input) : FieldQueries{input.mesh, {}, {}} {
    const ExactSurface exact(mesh);
    findHits(exact, input.queries);
    findDepths(exact, input.queries);
  }

 private:
  /// Segments that begin outside and hit the mesh, with the parameter of the first hit.
  void findHits(const ExactSurface& exact, int count) {
    const double side = sideOf(exact.mesh());
    AlignedBox3d box = boundingBox(exact.mesh());
    box = {box.min().array() - 0.2 * side, box.max().array() + 0.2 * side};
    Random random(1);
    for (int tries = 0; int(segments.size()) < count; ++tries) {
      if (tries > 1000 * count) throw std::runtime_error("no segment meets the mesh");
      const Segment segment{uniformIn(random, box), uniformIn(random, box)};
      if (exact.distance(segment.start) < kFree * side) continue;
      const std::optional<double> hit = exact.firstHit(segment);
      if (!hit) continue;
      segments.push_back(segment);
      times.push_back(*hit);
    }
  }

  /// Points just inside the mesh, with their signed distances.
  void findDepths(const ExactSurface& exact, int count) {
    const double deepest = kDeepest * sideOf(exact.mesh());
    const SurfaceSampler surface(exact.mesh());
    Random random(2);
    for (int tries = 0; int(points.size()) < count; ++tries) {
      if (tries > 1000 * count) throw std::runtime_error("no point is inside the mesh");
      const Vector3d p = surface(random) + uniform(random, 0.0, deepest) * direction(random);
      const double distance = exact.distance(p);
      if (distance > 0.0) continue;
      points.push_back(p);
      distances.push_back(distance);
    }
  }
};

System<double> oneByOne(const Label& label, const DistanceField& field, const std::vector<Segment>& segments) {
  return {label, [field, &segments](std::vector<double>& times) {
            Intervals intervals;
            for (std::size_t i = 0; i < segments.size(); ++i) {
              segmentIntervals(field, segments[i], {0.0, SegmentMode::kFirst}, intervals);
              times[i] = intervals.empty() ? -1.0 : intervals.front().enter;
            }
          }};
}

System<double> batched(Label label, const DistanceField& field, const std::vector<Segment>& segments) {
  label.system.replace(0, std::string("sdf_ccd").size(), "sdf_ccd batch");
  return {label, [field, &segments](std::vector<double>& times) {
            thread_local BatchResult batch;
            times.assign(segments.size(), -1.0);
            segmentIntervals(field, segments.data(), segments.size(), {0.0, SegmentMode::kFirst}, batch);
            for (const SegmentHit& hit : batch.hits) times[hit.segment] = hit.enter;
          }};
}

/// Builds all fields before anything is timed, so that the systems can be timed in turn.
class FieldStudy {
 public:
  explicit FieldStudy(const StudyInput& input) : input_(input), side_(sideOf(input.mesh)), exact_(input) {}

  double side() const { return side_; }

  void addField(Label label, FieldOptions options, double share_before, double share_after) {
    options.band = std::max(options.band, 2.0 * kDeepest * side_);
    const DistanceField field = buildField(input_.mesh, options, [&](double share) {
      input_.progress(0.8 * (share_before + share * (share_after - share_before)));
    });
    label.bound = field.errorBound();
    systems_.hits.push_back(oneByOne(label, field, exact_.segments));
    batches_.push_back(batched(label, field, exact_.segments));
    systems_.distances.push_back({label, [field, this](std::vector<double>& distances) {
                                    for (std::size_t i = 0; i < exact_.points.size(); ++i)
                                      distances[i] = field.interpolate(exact_.points[i]).value;
                                  }});
  }

  void addPeers(int cells) { input_.add_peers(exact_, cells, systems_); }

  std::vector<Measurement> measured() {
    std::move(batches_.begin(), batches_.end(), std::back_inserter(systems_.hits));
    addPeers(0);
    const auto hit_error = [&](std::size_t i, double time) {
      const Segment& segment = exact_.segments[i];
      return time < 0.0 ? Label::kNone : std::abs(time - exact_.times[i]) * (segment.end - segment.start).norm();
    };
    const auto distance_error = [&](std::size_t i, double d) { return std::abs(d - exact_.distances[i]); };
    std::vector<Measurement> rows = measure<double>(systems_.hits, exact_.segments.size(),
                                                    {{"time of impact (length along the path)", "m", hit_error}},
                                                    [&](double share) { input_.progress(0.8 + 0.1 * share); });
    for (Measurement& row :
         measure<double>(systems_.distances, exact_.points.size(), {{"depth", "m", distance_error, true}},
                         [&](double share) { input_.progress(0.9 + 0.1 * share); }))
      rows.push_back(std::move(row));
    return rows;
  }

 private:
  const StudyInput& input_;
  double side_;
  ExactQueries exact_;
  std::vector<System<double>> batches_;
  FieldSystems systems_;
};

}  // namespace

StudyResult cellStudy(const StudyInput& input) {
  StudyResult result{
      "cell", "Uniform fields: error against the exact mesh over the cell size", "cell [m]", "segment or point", {}};
  FieldStudy study(input);
  std::vector<int> counts{16, 32, 64, 128};
  if (!input.quick) counts.push_back(256);
  // The cost of a field grows with the square of the cells along a side, so the last field takes three quarters of all.
  double before = 0.0, all = 0.0;
  for (const int cells : counts) all += double(cells) * cells;
  for (const int cells : counts) {
    const double cell = study.side() / cells;
    FieldOptions options;
    options.cells = cells;
    const double after = before + double(cells) * cells / all;
    study.addField({"sdf_ccd (uniform cells)", lengthText(cell), cell}, options, before, after);
    before = after;
    study.addPeers(cells);
  }
  result.rows = study.measured();
  return result;
}

StudyResult maxErrorStudy(const StudyInput& input) {
  StudyResult result{"max-error",
                     "Adaptive fields: error against the exact mesh over the maximum error",
                     "maximum error [m]",
                     "segment or point",
                     {}};
  FieldStudy study(input);
  std::vector<double> errors{3e-2, 1e-2, 3e-3, 1e-3};
  if (!input.quick) errors.push_back(3e-4);
  double before = 0.0, all = 0.0;
  for (const double error : errors) all += 1.0 / error;
  for (const double error : errors) {
    const double after = before + 1.0 / error / all;
    FieldOptions options;
    options.max_error = error * study.side();
    study.addField({"sdf_ccd (max_error)", lengthText(*options.max_error), *options.max_error}, options, before, after);
    before = after;
  }
  result.rows = study.measured();
  return result;
}

}  // namespace sdf_ccd::precision
