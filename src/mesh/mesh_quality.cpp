#include "sdf_ccd/mesh.h"

#include <fmt/format.h>

#include "common/counted.h"

namespace sdf_ccd {

std::string summary(const MeshQuality& quality) {
  std::string text = counted(quality.triangles, "triangle");
  const auto count = [&](int number, const char* noun, const char* what) {
    if (number > 0) text += ", " + counted(number, noun) + what;
    return number > 0;
  };
  const auto area = [&](double area) { text += fmt::format(" ({:.3g} m^2)", area); };
  if (quality.components > 1) count(quality.components, "component", "");
  count(quality.degenerate_triangles, "degenerate triangle", "");
  if (quality.boundary_edges == 0) text += ", closed";
  count(quality.boundary_edges, "boundary edge", "");
  count(quality.non_manifold_edges, "non-manifold edge", "");
  count(quality.misoriented_edges, "misoriented edge", "");
  if (count(quality.duplicate_triangles, "duplicate triangle", " left out")) area(quality.duplicate_area);
  if (count(quality.hidden_triangles, "triangle", " of interior walls removed")) area(quality.hidden_area);
  count(quality.wall_triangles, "triangle", " of walls without thickness");
  count(quality.inverted_components, "inverted component", " flipped");
  count(quality.inverted_sheets, "open part", " flipped");
  count(quality.negative_triangles, "triangle", " inside out by self-intersection");
  return text +
         fmt::format(", volume {:.3g} m^3, sign {}", quality.volume, quality.sign_trusted ? "trusted" : "doubtful");
}

std::string warningOf(const MeshQuality& quality) {
  std::string text = quality.sign_trusted ? "" : "inside and outside are uncertain";
  const auto say = [&](int number, const char* one, const char* many) {
    if (number > 0) text += fmt::format("{}{} {}", text.empty() ? "" : "; ", number, number == 1 ? one : many);
  };
  say(quality.inverted_components, "component was inside out and has been flipped",
      "components were inside out and have been flipped");
  say(quality.inverted_sheets, "open part was inside out and has been flipped",
      "open parts were inside out and have been flipped");
  say(quality.negative_triangles, "triangle of a self-intersecting part is inside out",
      "triangles of self-intersecting parts are inside out");
  return text;
}

}  // namespace sdf_ccd
