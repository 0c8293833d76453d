/// The study `quadrature`: rules for integrating contact impulses.

#include <cmath>
#include <string>

#include "contact_query.h"
#include "sdf_ccd/field/build_field.h"
#include "studies.h"
#include "timing.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kQuadratureCells = 64;
constexpr double kQuadratureSpacing = 0.05;  // of the shell's points [box sides]
constexpr int kReferencePoints = 10'000;

struct Rule {
  Label label;
  ContactOptions options;
};

Rule midpoint(int points) {
  Rule rule{{"midpoint rule", "N = " + std::to_string(points), double(points)}, {}};
  rule.options.quadrature = Quadrature::kMidpoint;
  rule.options.midpoint_intervals = points;
  return rule;
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
    const auto run = [&](ContactOptions options, std::vector<Vector3d>& impulses) {
      options.normal = normal;
      for (std::size_t i = 0; i < queries.size(); ++i) impulses[i] = queries[i].integrate(options).on_shell_body.force;
    };
    std::vector<Vector3d> exact(queries.size());
    run(midpoint(kReferencePoints).options, exact);
    input.progress(0.2 + 0.4 * (done + 0.7));
    std::vector<Rule> rules;
    for (const int points : {5, 10, 20, 40}) rules.push_back(midpoint(points));
    rules.push_back({{"exact rule", ""}, {}});
    std::vector<std::vector<Vector3d>> found(rules.size(), exact);
    std::vector<std::function<void()>> tasks;
    for (std::size_t k = 0; k < rules.size(); ++k) tasks.push_back([&, k] { run(rules[k].options, found[k]); });
    const std::vector<double> seconds = secondsPerQuery(
        tasks, queries.size(), [&](double share) { input.progress(0.2 + 0.4 * (done + 0.7 + 0.3 * share)); });
    for (std::size_t k = 0; k < rules.size(); ++k) {
      std::vector<double> errors;
      for (std::size_t i = 0; i < queries.size(); ++i)
        errors.push_back((found[k][i] - exact[i]).norm() / exact[i].norm());
      const char* source = normal == NormalSource::kField ? "field" : "shell";
      result.rows.push_back({rules[k].label, std::string("impulse with normals of the ") + source, "of the impulse",
                             seconds[k], summarize(std::move(errors))});
    }
    done += 1.0;
  }
  return result;
}

}  // namespace sdf_ccd::precision
