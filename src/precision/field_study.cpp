/// The studies `cell` and `max-error`: fields against the exact mesh.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/number_text.h"
#include "exact_surface.h"
#include "random_inputs.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/query/segment_query.h"
#include "studies.h"
#include "timing.h"

namespace sdf_ccd::precision {
namespace {

constexpr double kDeepest = 0.005;  ///< maximum depth of the points [box sides]
constexpr double kFree = 0.06;      ///< minimum distance of starts [box sides], so that they are outside in any field

double sideOf(const TriangleMesh& mesh) {
  return boundingBox(mesh).sizes().maxCoeff();
}

/// Segments that begin outside and hit the mesh, with the parameter of the first hit.
struct ExactHits {
  std::vector<Segment> segments;
  std::vector<double> times;

  ExactHits(const ExactSurface& mesh, int count) {
    const double side = sideOf(mesh.mesh());
    AlignedBox3d box = boundingBox(mesh.mesh());
    box = {box.min().array() - 0.2 * side, box.max().array() + 0.2 * side};
    Random random(1);
    for (int tries = 0; int(segments.size()) < count; ++tries) {
      if (tries > 1000 * count) throw std::runtime_error("no segment meets the mesh");
      const Segment segment{uniformIn(random, box), uniformIn(random, box)};
      if (mesh.distance(segment.start) < kFree * side) continue;
      const std::optional<double> hit = mesh.firstHit(segment);
      if (!hit) continue;
      segments.push_back(segment);
      times.push_back(*hit);
    }
  }
};

/// Points just inside the mesh, with their signed distances.
struct ExactDepths {
  std::vector<Vector3d> points;
  std::vector<double> distances;

  ExactDepths(const ExactSurface& mesh, int count) {
    const double deepest = kDeepest * sideOf(mesh.mesh());
    const SurfaceSampler surface(mesh.mesh());
    Random random(2);
    for (int tries = 0; int(points.size()) < count; ++tries) {
      if (tries > 1000 * count) throw std::runtime_error("no point is inside the mesh");
      const Vector3d p = surface(random) + uniform(random, 0.0, deepest) * direction(random);
      const double distance = mesh.distance(p);
      if (distance > 0.0) continue;
      points.push_back(p);
      distances.push_back(distance);
    }
  }
};

void measureHits(const ExactHits& exact, const std::vector<HitSystem>& systems, const StudyInput& input,
                 StudyResult& result) {
  std::vector<std::vector<double>> found(systems.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t k = 0; k < systems.size(); ++k) {
    tasks.push_back([&, k] { systems[k].first_hits(exact.segments, found[k]); });
  }
  const std::vector<double> seconds =
      secondsPerQuery(tasks, exact.segments.size(), [&](double share) { input.progress(0.8 + 0.1 * share); });
  for (std::size_t k = 0; k < systems.size(); ++k) {
    Measurement row{systems[k].label, "time of impact (length along the path)", "m"};
    row.bound = Measurement::kNone;  // it bounds the surface's location, not the time of impact
    row.seconds = seconds[k];
    std::vector<double> errors;
    for (std::size_t i = 0; i < exact.segments.size(); ++i) {
      const Segment& segment = exact.segments[i];
      if (found[k][i] >= 0.0) {
        errors.push_back(std::abs(found[k][i] - exact.times[i]) * (segment.end - segment.start).norm());
      } else {
        ++row.missed;
      }
    }
    if (errors.empty()) continue;
    row.error = summarize(std::move(errors));
    result.rows.push_back(row);
  }
}

void measureDepths(const ExactDepths& exact, const std::vector<DistanceSystem>& systems, const StudyInput& input,
                   StudyResult& result) {
  std::vector<std::vector<double>> found(systems.size(), std::vector<double>(exact.points.size()));
  std::vector<std::function<void()>> tasks;
  for (std::size_t k = 0; k < systems.size(); ++k) {
    tasks.push_back([&, k] {
      for (std::size_t i = 0; i < exact.points.size(); ++i) found[k][i] = systems[k].distance(exact.points[i]);
    });
  }
  const std::vector<double> seconds =
      secondsPerQuery(tasks, exact.points.size(), [&](double share) { input.progress(0.9 + 0.1 * share); });
  for (std::size_t k = 0; k < systems.size(); ++k) {
    Measurement row{systems[k].label, "depth", "m"};
    row.seconds = seconds[k];
    std::vector<double> errors;
    for (std::size_t i = 0; i < exact.points.size(); ++i) {
      errors.push_back(std::abs(found[k][i] - exact.distances[i]));
    }
    row.error = summarize(std::move(errors));
    result.rows.push_back(row);
  }
}

HitSystem oneByOne(const Label& label, const DistanceField& field) {
  return {label, [field](const std::vector<Segment>& segments, std::vector<double>& times) {
            times.assign(segments.size(), -1.0);
            Intervals intervals;
            for (std::size_t i = 0; i < segments.size(); ++i) {
              segmentIntervals(field, segments[i], {0.0, SegmentMode::kFirst}, intervals);
              if (!intervals.empty()) times[i] = intervals.front().enter;
            }
          }};
}

HitSystem batched(Label label, const DistanceField& field) {
  label.system.replace(0, std::string("sdf_ccd").size(), "sdf_ccd batch");
  return {label, [field](const std::vector<Segment>& segments, std::vector<double>& times) {
            thread_local BatchResult batch;
            times.assign(segments.size(), -1.0);
            segmentIntervals(field, segments.data(), segments.size(), {0.0, SegmentMode::kFirst}, batch);
            for (const SegmentHit& hit : batch.hits) times[hit.segment] = hit.enter;
          }};
}

template <typename System>
void append(std::vector<System>& systems, std::vector<System> more) {
  for (System& system : more) systems.push_back(std::move(system));
}

/// Builds all fields before anything is timed, so that the systems can be timed in turn.
class FieldStudy {
 public:
  explicit FieldStudy(const StudyInput& input) : input_(input), side_(sideOf(input.mesh)) {}

  double side() const { return side_; }

  void addField(Label label, FieldOptions options, double share_before, double share_after) {
    options.band = std::max(options.band, 2.0 * kDeepest * side_);
    const DistanceField field = buildField(input_.mesh, options, [&](double share) {
      input_.progress(0.8 * (share_before + share * (share_after - share_before)));
    });
    label.bound = field.errorBound();
    hits_.push_back(oneByOne(label, field));
    batches_.push_back(batched(label, field));
    distances_.push_back({label, [field](const Vector3d& p) { return field.interpolate(p).value; }});
  }

  void addGrids(int cells) {
    if (input_.peers.grid_hits) append(hits_, input_.peers.grid_hits(input_.mesh, cells));
    if (input_.peers.grid_distances) append(distances_, input_.peers.grid_distances(input_.mesh, cells));
  }

  void measure(StudyResult& result) {
    append(hits_, batches_);
    if (input_.peers.mesh_hits) append(hits_, input_.peers.mesh_hits(input_.mesh));
    const ExactSurface mesh(input_.mesh);
    measureHits(ExactHits(mesh, input_.queries), hits_, input_, result);
    measureDepths(ExactDepths(mesh, input_.queries), distances_, input_, result);
  }

 private:
  const StudyInput& input_;
  double side_;
  std::vector<HitSystem> hits_, batches_;
  std::vector<DistanceSystem> distances_;
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
    study.addGrids(cells);
  }
  study.measure(result);
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
  study.measure(result);
  return result;
}

}  // namespace sdf_ccd::precision
