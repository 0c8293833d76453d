/// The study `spacing`: force and depth over the spacing of a shell's points.

#include <cmath>

#include "common/number_text.h"
#include "contact_query.h"
#include "sdf_ccd/field/build_field.h"
#include "studies.h"
#include "timing.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kCells = 128;
constexpr double kReference = 0.004;  // spacing of the reference shell [box sides]

struct Contacts {
  std::vector<Vector3d> forces;
  std::vector<double> depths;
};

Contacts contactsOf(const DistanceField& field, const TreeShell& shell, const std::vector<Motion>& motions) {
  Contacts found;
  for (const Motion& motion : motions) {
    ContactQuery query(field, shell, motion);
    query.find();
    found.forces.push_back(query.integrate({}).on_shell_body.force);
    found.depths.push_back(query.deepest());
  }
  return found;
}

}  // namespace

StudyResult spacingStudy(const StudyInput& input) {
  StudyResult result{"spacing",
                     "Shells: force and depth over the spacing of the points, compared with a far denser shell",
                     "spacing (points) [m]",
                     "pair of bodies",
                     {}};
  FieldOptions field_options;
  field_options.cells = kCells;
  const double side = boundingBox(input.mesh).sizes().maxCoeff();
  field_options.band = 0.06 * side;
  const DistanceField field = buildField(input.mesh, field_options, [&](double share) { input.progress(0.3 * share); });
  const TreeShell reference(input.mesh, kReference * side);
  const std::vector<Motion> motions =
      presses(field, reference, std::max(10, input.queries / 20), 0.01 * side, 0.04 * side, 0.005 * side);
  const Contacts exact = contactsOf(field, reference, motions);
  input.progress(0.6);

  const std::vector<double> spacings{0.1, 0.05, 0.025, 0.0125, 0.00625};  // [box sides]
  std::vector<TreeShell> shells;
  for (const double share : spacings) shells.emplace_back(input.mesh, share * side);
  std::vector<Contacts> found(shells.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t k = 0; k < shells.size(); ++k)
    tasks.push_back([&, k] { found[k] = contactsOf(field, shells[k], motions); });
  const std::vector<double> seconds =
      secondsPerQuery(tasks, motions.size(), [&](double share) { input.progress(0.6 + 0.4 * share); });
  std::vector<Measurement> depths;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    std::vector<double> force_errors, depth_errors;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      force_errors.push_back((found[k].forces[i] - exact.forces[i]).norm() / exact.forces[i].norm());
      depth_errors.push_back(std::abs(exact.depths[i] - found[k].depths[i]));
    }
    const double spacing = spacings[k] * side;
    Label label{"sdf_ccd", lengthText(spacing) + " (" + std::to_string(shells[k].shell.size()) + ")", spacing};
    result.rows.push_back({label, "force", "of the force", seconds[k], summarize(std::move(force_errors))});
    label.bound = shells[k].shell.covering_radius;
    depths.push_back({label, "missed depth", "m", seconds[k], summarize(std::move(depth_errors))});
  }
  result.rows.insert(result.rows.end(), depths.begin(), depths.end());
  return result;
}

}  // namespace sdf_ccd::precision
