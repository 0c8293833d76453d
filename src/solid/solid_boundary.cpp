#include "solid/solid_boundary.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/counted.h"
#include "common/infinity.h"
#include "common/parallel_for.h"
#include "doubtful_reach.h"
#include "triangle_cutter.h"

namespace sdf_ccd {
namespace {

constexpr double kDoubtToSpeakOf = 1e-4;  // of the area
constexpr double kReachOfSize = 2e-6;     // to which SolidReport::doubtful_reach is measured

bool isKept(Sides sides) {
  return sides != Sides::kInterior && sides != Sides::kDuplicate;
}

/// Collects the triangles and pieces of a mesh that are kept.
class BoundaryWriter {
 public:
  BoundaryWriter(const TriangleMesh& mesh, const SurfaceTolerance& tolerance, SolidReport& report)
      : mesh_(mesh), tolerance_(tolerance), report_(report) {
    boundary_.vertices = mesh.vertices;
  }

  void addWhole(int triangle, Sides sides, bool tells_sides = true) {
    if (!isKept(sides)) {
      ++report_.dropped;
      return;
    }
    add(mesh_.triangles[triangle], sides, tells_sides);
    if (sides == Sides::kUnknown) noteDoubtful({cornersOf(mesh_, triangle)});
    report_.reversed += sides == Sides::kInward;
  }

  void addParts(int triangle, const std::vector<SurfacePart>& parts) {
    // Cuts are needed only if they drop a part, or separate an outward part from an inward one.
    const auto has = [&](Sides sides) {
      return std::any_of(parts.begin(), parts.end(), [&](const SurfacePart& part) { return part.sides == sides; });
    };
    const bool one = parts.size() == 1, clipped = has(Sides::kInterior) || has(Sides::kDuplicate);
    if (one || (!clipped && !(has(Sides::kOutward) && has(Sides::kInward)))) {
      if (one) return addWhole(triangle, parts.front().sides, parts.front().tells_sides);
      add(mesh_.triangles[triangle], Sides::kUnknown, false);
      noteDoubtful(trianglesOf(parts, Sides::kUnknown));
      for (const Sides certain : {Sides::kOutward, Sides::kInward})
        for (const Corners& t : trianglesOf(parts, certain)) addTriangle(t, certain_);
      return;
    }
    report_.clipped += clipped;
    noteDoubtful(trianglesOf(parts, Sides::kUnknown));
    for (const SurfacePart& part : parts) {
      if (isKept(part.sides)) addPiece(part);
    }
  }

  /// Sets SolidReport::doubtful_reach, unless so much is doubtful that users are warned.
  void measureDoubt() {
    report_.doubtful_area /= surfaceArea(mesh_);
    if (doubtful_.empty()) return;
    report_.doubtful_reach = kInfinity;
    const double tolerance = kReachOfSize * boundingBox(mesh_).sizes().maxCoeff();
    if (report_.doubtful_area > kDoubtToSpeakOf) return;
    for (std::size_t i = 0; i < boundary_.triangles.size(); ++i)
      if (is_certain_[i]) addTriangle(cornersOf(boundary_, static_cast<int>(i)), certain_);
    if (!certain_.triangles.empty()) report_.doubtful_reach = reachFrom(TriangleTree(certain_), doubtful_, tolerance);
  }

  TriangleMesh takeMesh() { return std::move(boundary_); }
  std::vector<std::uint8_t> takeSeparates() { return std::move(separates_); }

 private:
  static std::vector<Corners> trianglesOf(const std::vector<SurfacePart>& parts, Sides sides) {
    std::vector<Corners> all;
    for (const SurfacePart& part : parts) {
      if (part.sides != sides) continue;
      const auto& corners = part.piece.corners();
      for (const auto& t : part.piece.triangles())
        all.push_back({corners[t[0]].point, corners[t[1]].point, corners[t[2]].point});
    }
    return all;
  }

  static void addTriangle(const Corners& corners, TriangleMesh& mesh) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }

  /// Of one triangle of the mesh.
  void noteDoubtful(const std::vector<Corners>& parts) {
    double area = 0.0;
    for (const Corners& part : parts) area += 0.5 * areaNormal(part).norm();
    report_.doubtful += area > 0.0;
    report_.doubtful_area += area;
    doubtful_.insert(doubtful_.end(), parts.begin(), parts.end());
  }

  void add(Vector3i corners, Sides sides, bool tells_sides) {
    if (sides == Sides::kInward) std::swap(corners[1], corners[2]);
    boundary_.triangles.push_back(corners);
    const bool has_sides = sides == Sides::kOutward || sides == Sides::kInward;
    is_certain_.push_back(has_sides);
    const int last = static_cast<int>(boundary_.triangles.size()) - 1;
    separates_.push_back(tells_sides && has_sides && hasCertainPlane(boundary_, last, tolerance_));
  }

  void addPiece(const SurfacePart& part) {
    std::vector<int> vertices;
    for (const FlatCorner& corner : part.piece.corners()) {
      vertices.push_back(corner.vertex >= 0 ? corner.vertex : static_cast<int>(boundary_.vertices.size()));
      if (corner.vertex < 0) boundary_.vertices.push_back(corner.point);
    }
    for (const auto& t : part.piece.triangles()) {
      add({vertices[t[0]], vertices[t[1]], vertices[t[2]]}, part.sides, part.tells_sides);
      ++report_.pieces;
      report_.reversed += part.sides == Sides::kInward;
    }
  }

  const TriangleMesh& mesh_;
  SurfaceTolerance tolerance_;
  SolidReport& report_;
  TriangleMesh boundary_;
  std::vector<std::uint8_t> separates_, is_certain_;  // per triangle of the boundary
  TriangleMesh certain_;  // what certainly bounds the solid of triangles that are kept whole though in part doubtful
  std::vector<Corners> doubtful_;
};

/// Parts of triangles that others cut; none for triangles that cost too much.
///
/// The cost of a triangle is not known in advance, and varies by a factor of thousands. Each triangle first gets a
/// budget that is enough for most; those that need more start again with four times the budget, and so on, until the
/// total budget is spent. So a few expensive triangles do not use up the budget of the many, and many triangles that
/// cannot be decided cost no more than the total.
std::vector<std::vector<SurfacePart>> partsOf(std::vector<int> cut, const CutLists& cuts, const TriangleCutter& cutter,
                                              const SolidLimits& limits) {
  using Cost = TriangleCutter::Cost;
  constexpr Cost kFirst{1'000, 10'000};
  constexpr std::size_t kMore = 4;
  std::vector<std::vector<SurfacePart>> parts(cuts.of.size());
  Cost left{limits.steps, limits.visits};
  bool is_last = false;
  for (Cost each = kFirst; !cut.empty() && !is_last; each = {kMore * each.steps, kMore * each.visits}) {
    const Cost share{left.steps / cut.size(), left.visits / cut.size()};
    is_last = share.steps < each.steps || share.visits < each.visits;
    const Cost most{std::min(each.steps, share.steps), std::min(each.visits, share.visits)};
    std::vector<Cost> costs(cut.size());
    parallelFor(std::size_t{0}, cut.size(), [&](std::size_t i) {
      TriangleCutter::Result result = cutter.parts(cut[i], cuts.of[cut[i]], most);
      parts[cut[i]] = std::move(result.parts);
      costs[i] = result.cost;
    });
    for (const Cost& cost : costs) {
      left.steps -= std::min(left.steps, cost.steps);
      left.visits -= std::min(left.visits, cost.visits);
    }
    cut.erase(std::remove_if(cut.begin(), cut.end(), [&](int triangle) { return !parts[triangle].empty(); }),
              cut.end());
  }
  return parts;
}

}  // namespace

Solid::Solid(const TriangleMesh& mesh, const SolidLimits& limits)
    : tree_(std::make_shared<TriangleTree>(mesh)), interior_(mesh, tree_), boundary_(mesh) {
  const std::shared_ptr<const TriangleTree> all = tree_;
  if (!closed()) {
    separates_.assign(mesh.triangles.size(), 0);
    return;
  }
  const SurfaceTolerance tolerance = surfaceTolerance(mesh);
  const CutLists cuts = cutLists(mesh, *all, tolerance, limits.pairs);
  const std::vector<Sides> sides = sidesOfUncut(mesh, *all, interior_, cuts, tolerance);
  separates_.resize(sides.size());
  std::transform(sides.begin(), sides.end(), separates_.begin(), [](Sides s) { return s == Sides::kOutward; });
  report_.pairs = cuts.pairs;
  if (!cuts.complete) {
    report_.failure = "more than " + std::to_string(limits.pairs) + " pairs of triangles cut each other";
    return;
  }
  std::vector<int> cut;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (!cuts.of[i].empty()) cut.push_back(static_cast<int>(i));
  }
  const bool as_it_is = cut.empty() && std::all_of(sides.begin(), sides.end(), [](Sides s) {
                          return s != Sides::kInterior && s != Sides::kInward && s != Sides::kUnknown;
                        });
  if (as_it_is) return;

  const TriangleCutter cutter(mesh, *all, interior_, tolerance);
  const std::vector<std::vector<SurfacePart>> parts = partsOf(std::move(cut), cuts, cutter, limits);
  BoundaryWriter writer(mesh, tolerance, report_);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const int triangle = static_cast<int>(i);
    parts[i].empty() ? writer.addWhole(triangle, sides[i]) : writer.addParts(triangle, parts[i]);
  }
  writer.measureDoubt();
  if (report_.dropped == static_cast<int>(sides.size())) {
    report_.failure = "no triangle has the outside in front of it";
    return;
  }
  seam_ = 4.0 * tolerance.border;
  boundary_ = writer.takeMesh();
  separates_ = writer.takeSeparates();
  tree_ = std::make_shared<TriangleTree>(boundary_);
}

std::string summary(const SolidReport& report) {
  if (!report.failure.empty()) return "all triangles kept: " + report.failure;
  std::string text;
  const auto add = [&](int count, const std::string& what) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + counted(count, "triangle") + " " + what;
  };
  add(report.dropped, "inside the solid removed");
  add(report.clipped, "clipped into " + std::to_string(report.pieces));
  add(report.reversed, "flipped");
  add(report.doubtful, "doubtful");
  if (report.doubtful > 0) text += fmt::format(" ({:.2g} % of the area)", 100.0 * report.doubtful_area);
  return text;
}

std::string warning(const SolidReport& report) {
  if (!report.failure.empty()) {
    return "depths may be those of faces inside the solid, because " + report.failure;
  }
  if (report.doubtful_area <= kDoubtToSpeakOf) return {};
  return fmt::format(
      "depths may be those of faces inside the solid: {} triangles ({:.2g} % of the area) cannot be classified as "
      "outside or inside",
      report.doubtful, 100.0 * report.doubtful_area);
}

}  // namespace sdf_ccd
