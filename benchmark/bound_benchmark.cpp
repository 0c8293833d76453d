/// Compares reported error bounds with true errors against exact meshes: whether they hold, and how tight they are.
/// Prints rows of results.csv.

#include <algorithm>
#include <cmath>
#include <map>

#include "bound/deepest_point.h"
#include "bound/reference.h"
#include "bound/tally.h"
#include "bound/test_points.h"
#include "bound/verdicts.h"
#include "contact/penalty.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/uniform/sparse_grid.h"
#include "query/least_distance.h"
#include "sdf_ccd/segments.h"
#include "shell/point_shell.h"
#include "study_fields.h"

namespace sdf_ccd::benchmark {
namespace {

using precision::ExactSurface;
using precision::Random;

constexpr double kRoot = 1e-9;           ///< tolerance of segmentIntervals() [path lengths]
constexpr std::size_t kCompared = 2000;  ///< points and segments that are compared with CGAL

using Tallies = std::map<std::string, BoundTally>;

/// Compares one field with its mesh.
class FieldStudy {
 public:
  FieldStudy(const DistanceField& field, const ExactSurface& mesh)
      : field_(field), mesh_(mesh), rounding_(1e-12 * boundingBox(mesh.mesh()).sizes().maxCoeff()) {}

  /// Distances and their bounds at points.
  void checkPoints(const std::vector<ExactPoint>& points) {
    for (const ExactPoint& point : points) {
      const FieldSample sample = field_.sample(point.p);
      const bool near = std::abs(point.distance) <= field_.band();
      tally(near ? "distance" : "distance_far").add(std::abs(sample.value - point.distance), sample.error);
      const DistanceBounds bounds = field_.bounds(point.p);
      tally("bounds").check(bounds.low <= point.distance + rounding_ && point.distance - rounding_ <= bounds.high);
    }
  }

  /// Intervals and times of impact of segments that start outside.
  void checkSegments(const std::vector<Segment>& segments) {
    for (const Segment& segment : segments) {
      const double length = (segment.end - segment.start).norm();
      for (const Interval& interval : segmentIntervals(field_, segment)) {
        for (const double t : {interval.enter, interval.exit}) {
          if (t > 0.0 && t < 1.0) addHit("hit", segment, t);
        }
      }
      addTime(segment, length);
    }
    BatchResult batch;
    segmentIntervals(field_, segments.data(), segments.size(), {}, batch);
    for (const SegmentHit& hit : batch.hits) {
      for (const double t : {double(hit.enter), double(hit.exit)}) {
        if (t > 0.0 && t < 1.0) addHit("hit_batch", segments[hit.segment], t);
      }
    }
  }

  /// Depths of points moving along segments.
  void checkDepths(const std::vector<Segment>& segments) {
    const std::vector<SiblingField> no_siblings;
    for (const Segment& segment : segments) {
      Isometry3d X_end = Isometry3d::Identity();
      X_end.translation() = segment.end - segment.start;
      const ChordPath path{{{0.0, 1.0, Isometry3d::Identity(), X_end, 0}}, 0.0};
      PointShell shell;
      shell.origin = segment.start;
      shell.add(segment.start, Vector3d::UnitZ(), 1.0F);
      std::vector<ShellHit> hits;
      for (const Interval& interval : segmentIntervals(field_, segment)) hits.push_back({0, 0, interval});
      if (hits.empty()) continue;
      ContactImpulse impulse;
      const std::vector<Isometry3d> rest(2, Isometry3d::Identity());
      integrateContact({field_, shell, path, rest, no_siblings}, hits, {}, {false, true}, impulse);
      double deepest = 0.0;
      for (const HitDepth& depth : impulse.depths) {
        deepest = std::max(deepest, depth.depth);
        addDepth("depth_at_place", depth.depth, -mesh_.distance(depth.p_C), depth.error);
      }
      const LeastDistance least = leastDistance(field_, segment);
      const double bound = std::max(deepest + least.high, -least.low - deepest);
      const double fine = 1e-5 * field_.errorBound();
      const DeepestPoint exact = deepestOn(mesh_, segment, {fine, 1e3 * fine, field_.band()});
      addDepth("depth", deepest, exact.depth, bound + exact.tolerance);
    }
  }

  Tallies& tallies() { return tallies_; }

 private:
  BoundTally& tally(const std::string& query) { return tallies_.try_emplace(query, rounding_).first->second; }

  /// Adds an end of an interval, a point that should lie on the surface. |φ| there is not exactly zero: up to the
  /// tolerance of the root, and more at a jump between two leaves.
  void addHit(const std::string& query, const Segment& segment, double t) {
    const Vector3d p = segment.start + t * (segment.end - segment.start);
    const FieldSample sample = field_.sample(p);
    tally(query).add(mesh_.unsignedDistance(p), std::abs(sample.value) + sample.error);
  }

  void addTime(const Segment& segment, double length) {
    const std::optional<double> exact = mesh_.firstHit(segment);
    const std::optional<ImpactWindow> window = impactWindow(field_, segment);
    BoundTally& times = tally("time_of_impact");
    const double slack = kRoot + rounding_ / length;
    if (!exact) return times.check(!window || !window->latest);
    if (!window || window->earliest > *exact + slack) return times.check(false);
    if (window->latest && *window->latest < *exact - slack) return times.check(false);
    if (!window->time || !window->latest) return times.check(true);  // the segment grazes: the time has no bound
    const double bound = std::max(*window->time - window->earliest, *window->latest - *window->time);
    times.add(length * std::abs(*window->time - *exact), length * (bound + slack));
  }

  void addDepth(const std::string& query, double depth, double exact, double bound) {
    if (exact > field_.band() - field_.errorBound()) return;
    tally(query).add(std::abs(depth - exact), bound);
  }

  const DistanceField& field_;
  const ExactSurface& mesh_;
  const double rounding_;
  Tallies tallies_;
};

/// Cell size [m]; in an adaptive field, the median over random points of the surface.
double cellAtSurface(const DistanceField& field, const ExactSurface& mesh) {
  if (const SparseGrid* grid = FieldAccess::grid(field)) return grid->shape().cell;
  const AdaptiveGrid& grid = *FieldAccess::adaptive(field);
  const AdaptiveShape& shape = grid.shape();
  Random random(7);
  const precision::SurfaceSampler surface(mesh.mesh());
  std::vector<double> sides(1001);
  for (double& side : sides) {
    const Vector3d p = (surface(random) - shape.origin) / shape.unit();
    side = grid.block(p.cast<int>()).side * shape.unit();
  }
  return precision::summarize(std::move(sides)).median;
}

void printVerdicts(const std::string& name, const VerdictTally& tally, double side, double cell) {
  const long all = tally.clear + tally.contact + tally.uncertain;
  const auto row = [&](const char* metric, double value, const char* unit) {
    print({"bound", name, "sdf_ccd", metric, value, unit, int(all)});
  };
  row("clear", double(tally.clear), "motions");
  row("contact", double(tally.contact), "motions");
  row("uncertain", double(tally.uncertain), "motions");
  row("uncertain_share", double(tally.uncertain) / double(all), "1");
  row("error_bound", tally.largest_bound / side, "box side");
  row("cell", cell / side, "box side");
}

void study(const NamedMesh& named, const StudyOptions& options) {
  const ExactSurface mesh(named.mesh);
  const double side = boundingBox(named.mesh).sizes().maxCoeff();
  Random random(3);
  const std::vector<ExactPoint> points = pointsOfMesh(mesh, options.segments, random);
  const std::vector<Segment> segments = segmentsOfMesh(mesh, options.segments, random);
  std::vector<ExactPoint> some_points = points;
  std::vector<Segment> some_segments = segments;
  std::shuffle(some_points.begin(), some_points.end(), random);
  std::shuffle(some_segments.begin(), some_segments.end(), random);
  some_points.resize(std::min(some_points.size(), kCompared));
  some_segments.resize(std::min(some_segments.size(), kCompared));
  const ReferenceDifference difference = compareWithCgal(mesh, some_points, some_segments);
  const auto reference = [&](const char* metric, double value, const char* unit) {
    print({"bound", named.name + "/reference", "cgal", metric, value, unit, int(kCompared)});
  };
  reference("distance_difference", difference.distance / side, "box side");
  reference("hit_difference", difference.hit / side, "box side");
  reference("hits_of_one_only", double(difference.lost), "segments");

  const VerdictStudy verdicts(mesh, options.pairs);
  Tallies all;
  for (const StudyField& wanted : studyFields(named, options)) {
    withField(named, wanted, [&](const DistanceField& field) {
      FieldStudy study(field, mesh);
      study.checkPoints(points);
      study.checkPoints(pointsOfField(field, mesh, options.segments, random));
      study.checkSegments(segments);
      study.checkSegments(segmentsOfField(field, mesh, options.segments, random));
      study.checkDepths(some_segments);
      const VerdictTally verdict = verdicts.run(wanted.options);
      study.tallies().insert({{"verdict", verdict.verdicts}, {"clearance", verdict.clearance}});
      study.tallies().insert({"pair_depth", verdict.depth});
      const std::string of_field = wanted.name.substr(named.name.size());
      for (const auto& [query, tally] : study.tallies()) {
        tally.printRows(named.name + "/" + query + of_field, side);
        all.try_emplace(query, 1e-12 * side).first->second += tally;
      }
      printVerdicts(named.name + "/verdict" + of_field, verdict, side, cellAtSurface(field, mesh));
    });
  }
  for (const auto& [query, tally] : all) tally.printRows(named.name + "/" + query, side);
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.cells = {32, 64, 128};
  full.errors = {"1e-2", "3e-3", "1e-3"};
  full.segments = 2'500;
  full.pairs = 100;
  full.meshes = {"bunny3k", "bunny75k", "armadillo", "link", "robot_link", "torus", "box"};
  StudyOptions quick = full;
  quick.cells = {32};
  quick.errors = {"1e-2"};
  quick.segments = 1'000;
  quick.pairs = 40;
  return runStudy(argc, argv, "Reported error bounds against exact meshes", full, quick,
                  [](const StudyOptions& options) {
                    for (const NamedMesh& named : studyMeshes(options)) study(named, options);
                  });
}
