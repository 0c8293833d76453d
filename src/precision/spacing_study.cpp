/// The study `spacing`: force and depth over the spacing of a shell's points.

#include <cmath>
#include <memory>

#include "common/number_text.h"
#include "contact_query.h"
#include "sdf_ccd/field/build_field.h"
#include "studies.h"
#include "timing.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kCells = 128;
constexpr double kReference = 0.004;  // spacing of the reference shell [box sides]

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
  const ContactOptions contact;
  std::vector<Vector3d> exact_forces;
  std::vector<double> exact_depths;
  for (const Motion& motion : motions) {
    ContactQuery query(field, reference, motion);
    query.find();
    exact_forces.push_back(query.integrate(contact).on_shell_body.force);
    exact_depths.push_back(query.deepest());
  }
  input.progress(0.6);

  std::vector<std::unique_ptr<TreeShell>> shells;
  std::vector<Measurement> forces, depths;
  std::vector<std::vector<Vector3d>> found_forces;
  std::vector<std::vector<double>> found_depths;
  std::vector<std::function<void()>> tasks;
  for (const double share : {0.1, 0.05, 0.025, 0.0125, 0.00625}) {
    shells.push_back(std::make_unique<TreeShell>(input.mesh, share * side));
    Measurement row;
    row.system = "sdf_ccd";
    row.setting = lengthText(share * side) + " (" + std::to_string(shells.back()->shell.size()) + ")";
    row.value = share * side;
    row.quantity = "force";
    row.unit = "of the force";
    forces.push_back(row);
    row.quantity = "missed depth";
    row.unit = "m";
    row.bound = shells.back()->shell.covering_radius;
    depths.push_back(row);
  }
  found_forces.assign(shells.size(), std::vector<Vector3d>(motions.size()));
  found_depths.assign(shells.size(), std::vector<double>(motions.size()));
  for (std::size_t k = 0; k < shells.size(); ++k) {
    tasks.push_back([&, k] {
      for (std::size_t i = 0; i < motions.size(); ++i) {
        ContactQuery query(field, *shells[k], motions[i]);
        query.find();
        found_forces[k][i] = query.integrate(contact).on_shell_body.force;
        found_depths[k][i] = query.deepest();
      }
    });
  }
  const std::vector<double> seconds =
      secondsPerQuery(tasks, motions.size(), [&](double share) { input.progress(0.6 + 0.4 * share); });
  for (std::size_t k = 0; k < shells.size(); ++k) {
    std::vector<double> force_errors, depth_errors;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      force_errors.push_back((found_forces[k][i] - exact_forces[i]).norm() / exact_forces[i].norm());
      depth_errors.push_back(std::abs(exact_depths[i] - found_depths[k][i]));
    }
    forces[k].seconds = depths[k].seconds = seconds[k];
    forces[k].error = summarize(std::move(force_errors));
    depths[k].error = summarize(std::move(depth_errors));
  }
  result.rows = forces;
  result.rows.insert(result.rows.end(), depths.begin(), depths.end());
  return result;
}

}  // namespace sdf_ccd::precision
