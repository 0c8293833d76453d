/// The study `spacing`: force and depth over the spacing of a shell's points.

#include <cmath>
#include <memory>

#include "common/number_text.h"
#include "contact_query.h"
#include "sdf_ccd/field.h"
#include "studies.h"

namespace sdf_ccd::precision {
namespace {

constexpr int kCells = 128;
constexpr double kReference = 0.004;  // spacing of the reference shell [box sides]

struct Contact {
  Vector3d force;
  double depth;
};

void contactsOf(const DistanceField& field, const TreeShell& shell, const std::vector<Motion>& motions,
                std::vector<Contact>& found) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    ContactQuery query(field, shell, motions[i]);
    query.find();
    found[i].force = query.integrate({}).on_shell_body.force;
    found[i].depth = query.deepest();
  }
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
  std::vector<Contact> exact(motions.size());
  contactsOf(field, reference, motions, exact);
  input.progress(0.6);

  std::vector<System<Contact>> systems;
  for (const double share : {0.1, 0.05, 0.025, 0.0125, 0.00625}) {  // [box sides]
    const double spacing = share * side;
    const auto shell = std::make_shared<const TreeShell>(input.mesh, spacing);
    const std::string setting = lengthText(spacing) + " (" + std::to_string(shell->shell.size()) + ")";
    systems.push_back({{"sdf_ccd", setting, spacing, shell->shell.covering_radius},
                       [&, shell](std::vector<Contact>& found) { contactsOf(field, *shell, motions, found); }});
  }
  result.rows = measure<Contact>(
      systems, motions.size(),
      {{"force", "of the force",
        [&](std::size_t i, const Contact& c) { return (c.force - exact[i].force).norm() / exact[i].force.norm(); }},
       {"missed depth", "m", [&](std::size_t i, const Contact& c) { return std::abs(exact[i].depth - c.depth); },
        true}},
      [&](double share) { input.progress(0.6 + 0.4 * share); });
  return result;
}

}  // namespace sdf_ccd::precision
