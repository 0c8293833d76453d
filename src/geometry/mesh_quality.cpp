#include "sdf_ccd/geometry/mesh_quality.h"

#include <sstream>

namespace sdf_ccd {

std::string summary(const MeshQuality& quality) {
  std::ostringstream text;
  text.precision(3);
  const auto count = [&](int number, const char* one, const char* many) {
    if (number > 0) text << ", " << number << " " << (number == 1 ? one : many);
    return number > 0;
  };
  text << quality.triangles << (quality.triangles == 1 ? " triangle" : " triangles");
  if (quality.components > 1) text << ", " << quality.components << " components";
  count(quality.degenerate_triangles, "degenerate triangle", "degenerate triangles");
  if (quality.boundary_edges == 0) text << ", closed";
  count(quality.boundary_edges, "boundary edge", "boundary edges");
  count(quality.non_manifold_edges, "non-manifold edge", "non-manifold edges");
  count(quality.misoriented_edges, "misoriented edge", "misoriented edges");
  if (count(quality.duplicate_triangles, "duplicate triangle", "duplicate triangles")) {
    text << " left out (" << quality.duplicate_area << " m^2)";
  }
  if (quality.hidden_triangles > 0) {
    text << ", " << quality.hidden_triangles << " triangles of interior walls removed (" << quality.hidden_area
         << " m^2)";
  }
  count(quality.wall_triangles, "", "triangles of walls without thickness");
  count(quality.inverted_components, "inverted component flipped", "inverted components flipped");
  count(quality.inverted_sheets, "open part flipped", "open parts flipped");
  count(quality.negative_triangles, "triangle inside out by self-intersection",
        "triangles inside out by self-intersection");
  text << ", volume " << quality.volume << " m^3, sign " << (quality.sign_trusted ? "trusted" : "doubtful");
  return text.str();
}

std::string warningOf(const MeshQuality& quality) {
  std::ostringstream text;
  const auto say = [&](int number, const char* one, const char* many) {
    if (number > 0) text << (text.tellp() > 0 ? "; " : "") << number << " " << (number == 1 ? one : many);
  };
  if (!quality.sign_trusted) text << "inside and outside are uncertain";
  say(quality.inverted_components, "component was inside out and has been flipped",
      "components were inside out and have been flipped");
  say(quality.inverted_sheets, "open part was inside out and has been flipped",
      "open parts were inside out and have been flipped");
  say(quality.negative_triangles, "triangle of a self-intersecting part is inside out",
      "triangles of self-intersecting parts are inside out");
  return text.str();
}

}  // namespace sdf_ccd
