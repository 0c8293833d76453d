#include "adversarial/public_queries.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "adversarial/duel.h"
#include "motion/two_body_motion.h"
#include "surface/separation.h"

namespace sdf_ccd::test {
namespace {

constexpr int kRows = 8;  // of a query: four points at the start and at the end

/// "numerator,denominator,...,truth": a point and the truth. All numbers of these files are doubles exactly.
Vector3d readRow(const std::string& line, bool& touches) {
  std::istringstream text(line);
  text.imbue(std::locale::classic());
  Vector3d p;
  char comma = ',';
  for (int k = 0; k < 3; ++k) {
    double numerator = 0.0, denominator = 0.0;
    text >> numerator >> comma >> denominator >> comma;
    p[k] = numerator / denominator;
  }
  int truth = -1;
  text >> truth;
  if (!text || !p.allFinite() || (truth != 0 && truth != 1)) throw std::runtime_error("damaged row: " + line);
  touches = truth == 1;
  return p;
}

/// The displacement that all points share, exactly; false if they do not. It is rounded to doubles, by less than any
/// verdict allows for.
bool sharedPath(const std::vector<Vector3d>& start, const std::vector<Vector3d>& end, Vector3d& path) {
  using Exact = Eigen::Matrix<long double, 3, 1>;
  const Exact first = end[0].cast<long double>() - start[0].cast<long double>();
  path = first.cast<double>();
  for (std::size_t i = 1; i < start.size(); ++i) {
    if (Exact(end[i].cast<long double>() - start[i].cast<long double>()) != first) return false;
  }
  return true;
}

void readFile(const std::filesystem::path& path, std::size_t corners_a, std::vector<PublicQuery>& queries) {
  std::ifstream file(path);
  std::array<Vector3d, kRows> p;
  int row = 0, number = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty()) continue;
    bool touches = false;
    p[static_cast<std::size_t>(row)] = readRow(line, touches);
    if (++row < kRows) continue;
    row = 0;
    PublicQuery query;
    query.name = path.parent_path().parent_path().filename().string() + " " + path.stem().string() + " " +
                 std::to_string(number++);
    const auto middle = p.begin() + static_cast<long>(corners_a);
    query.a.assign(p.begin(), middle);
    query.b.assign(middle, p.begin() + 4);
    query.touches = touches;
    const std::vector<Vector3d> end_a(p.begin() + 4, middle + 4), end_b(middle + 4, p.end());
    if (sharedPath(query.a, end_a, query.path_a) && sharedPath(query.b, end_b, query.path_b)) queries.push_back(query);
  }
  if (row != 0) throw std::runtime_error(path.string() + ": ends within a query");
}

Isometry3d displaced(const Vector3d& by) {
  Isometry3d X = Isometry3d::Identity();
  X.translation() = by;
  return X;
}

BoxTree treeOf(const std::vector<Vector3d>& corners) {
  const Vector3d &a = corners.front(), &b = corners[corners.size() / 2], &c = corners.back();
  return BoxTree({{Corners{a, b, c}, 0.0}});
}

sdf_ccd::Separation separate(const PublicQuery& query, double resolution) {
  const BoxTree a = treeOf(query.a), b = treeOf(query.b);
  const Isometry3d start = Isometry3d::Identity();
  const ScrewMotion X_WA(start, displaced(query.path_a)), X_WB(start, displaced(query.path_b));
  const TwoBodyMotion motion{0.0, 1.0, X_WA, X_WB,
                             relativeMotionBounds(worldTwist(X_WA, a.ball()), worldTwist(X_WB, b.ball())).acceleration};
  SeparationWitness witness;
  SeparationMemory memory;
  return sdf_ccd::separation(a, b, motion, {0.0, resolution, 1'000'000}, witness, memory);
}

/// The prism over a convex polygon that is counterclockwise seen from the extrusion's end.
TriangleMesh prism(const std::vector<Vector3d>& polygon, const Vector3d& extrusion) {
  TriangleMesh mesh;
  const int n = static_cast<int>(polygon.size());
  for (const Vector3d& p : polygon) mesh.vertices.push_back(p);
  for (const Vector3d& p : polygon) mesh.vertices.push_back(p + extrusion);
  for (int i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({n, n + i, n + i + 1});
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
  }
  return mesh;
}

/// A thin convex body that contains an element: a vertex, an edge or a face.
Actor thinBody(const std::string& kind, const std::vector<Vector3d>& corners, double half) {
  if (corners.size() == 3) {
    const Vector3d n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    std::vector<Vector3d> below;
    for (const Vector3d& p : corners) below.push_back(p - half * n);
    return convexActor(kind, prism(below, 2.0 * half * n));
  }
  const Vector3d &from = corners.front(), &to = corners.back();
  const Vector3d along = to == from ? Vector3d::UnitZ() : Vector3d((to - from).normalized());
  const Vector3d u = half * along.unitOrthogonal(), v = along.cross(u), start = from - half * along;
  return convexActor(
      kind, prism({start - u - v, start + u - v, start + u + v, start - u + v}, to - from + 2.0 * half * along));
}

}  // namespace

std::vector<PublicQuery> readPublicQueries(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<PublicQuery> queries;
  for (const std::filesystem::path& file : files)
    readFile(file, file.parent_path().filename() == "vertex-face" ? 1 : 2, queries);
  return queries;
}

Tally publicTriangles(const std::vector<PublicQuery>& queries) {
  Tally tally;
  for (const double resolution : {1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2}) {
    for (const PublicQuery& query : queries) {
      ++tally.cases;
      switch (separate(query, resolution).state) {
        case SeparationState::kApart:
          ++tally.clear;
          tally.false_clear += query.touches;
          if (query.touches) tally.fail("apart", query.name);
          break;
        case SeparationState::kCrossing:
          ++tally.contact;
          tally.false_contact += !query.touches;
          if (!query.touches) tally.fail("crossing", query.name);
          break;
        case SeparationState::kOpen:
          ++tally.uncertain;
      }
    }
  }
  return tally;
}

Tally publicBodies(const std::vector<PublicQuery>& queries) {
  constexpr double kThin = 1e-4;  // half the thickness of a body [m]
  const BodyOptions scene = optionsForContacts();
  Tally tally;
  for (const PublicQuery& query : queries) {
    Duel duel(thinBody("a", query.a, kThin), thinBody("b", query.b, kThin), scene, {});
    const Isometry3d start = Isometry3d::Identity();
    const CycleMotion motion = pairCycle({start, displaced(query.path_a)}, {start, displaced(query.path_b)});
    const PairResult& result = duel.play(motion, tally);
    if (!query.touches || result.verdict != Verdict::kClear) continue;
    ++tally.false_clear;
    tally.fail("CLEAR against the public truth", query.name);
  }
  return tally;
}

}  // namespace sdf_ccd::test
