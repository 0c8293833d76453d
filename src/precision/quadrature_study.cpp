/// The study `quadrature`: rules for integrating contact impulses.

#include <cmath>
#include <string>

#include "contact_query.h"
#include "sdf_ccd/field.h"
#include "studies.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kQuadratureCells = 64;
constexpr double kQuadratureSpacing = 0.05;  // of the shell's points [box sides]
constexpr int kReferencePoints = 10'000;

ContactOptions midpoint(int points) {
  ContactOptions options;
  options.quadrature = Quadrature::kMidpoint;
  options.midpoint_intervals = points;
  return options;
}

}  // namespace

StudyResult quadratureStudy(const StudyInput& input) {
  StudyResult result{"quadrature",
                     "Impulses: midpoint rules and the exact rule, compared with the midpoint rule with 10,000 points",
                     "points per contact interval",
                     "pair of bodies",
                     {}};
  const double side = boundingBox(input.mesh).sizes().maxCoeff();
  FieldOptions field_options;
  field_options.cells = kQuadratureCells;
  field_options.band = 0.1 * side;
  const DistanceField field = buildField(input.mesh, field_options, [&](double share) { input.progress(0.2 * share); });
  const TreeShell shell(input.mesh, kQuadratureSpacing * side);
  const std::vector<Motion> motions =
      presses(field, shell, std::max(10, input.queries / 40), 0.0, 0.02 * side, 0.05 * side);
  std::vector<ContactQuery> queries;
  for (const Motion& motion : motions) queries.emplace_back(field, shell, motion).find();

  double done = 0.0;
  for (const NormalSource normal : {NormalSource::kField, NormalSource::kShell}) {
    const auto run = [&queries, normal](ContactOptions options, std::vector<Vector3d>& impulses) {
      options.normal = normal;
      for (std::size_t i = 0; i < queries.size(); ++i) impulses[i] = queries[i].integrate(options).on_shell_body.force;
    };
    std::vector<Vector3d> exact(queries.size());
    run(midpoint(kReferencePoints), exact);
    input.progress(0.2 + 0.4 * (done + 0.7));
    std::vector<System<Vector3d>> rules;
    for (const int points : {5, 10, 20, 40}) {
      rules.push_back({{"midpoint rule", "N = " + std::to_string(points), double(points)},
                       [run, points](std::vector<Vector3d>& found) { run(midpoint(points), found); }});
    }
    rules.push_back({{"exact rule", ""}, [run](std::vector<Vector3d>& found) { run({}, found); }});
    const std::string source = normal == NormalSource::kField ? "field" : "shell";
    const Quantity<Vector3d> impulse{
        "impulse with normals of the " + source, "of the impulse",
        [&](std::size_t i, const Vector3d& found) { return (found - exact[i]).norm() / exact[i].norm(); }};
    for (Measurement& row : measure<Vector3d>(rules, queries.size(), {impulse}, [&](double share) {
           input.progress(0.2 + 0.4 * (done + 0.7 + 0.3 * share));
         }))
      result.rows.push_back(std::move(row));
    done += 1.0;
  }
  return result;
}

}  // namespace sdf_ccd::precision
