#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "scene/name_pair.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::test {

/// One triangle, as an OFF file.
inline const char* const kTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n";

inline Resource loadOwn(const std::string& uri) {
  if (uri == "good.off") return {kTriangle, uri, ""};
  if (uri == "Good.OFF") return {kTriangle, uri, "Good.OFF: found good.off, the URI says Good.OFF"};
  if (uri == "garbage.off") return {"OFF\nhello", uri, ""};
  throw std::runtime_error(uri + ": no such file");
}

inline std::string mesh(const std::string& uri, const std::string& scale = "1 1 1") {
  return "<collision><geometry><mesh filename='" + uri + "' scale='" + scale + "'/></geometry></collision>";
}

inline std::string box(const std::string& size, const std::string& xyz = "0 0 0") {
  return "<collision><origin xyz='" + xyz + "' rpy='0 0 0'/><geometry><box size='" + size +
         "'/></geometry></collision>";
}

inline std::string link(const std::string& name, const std::string& inside = "") {
  return "<link name='" + name + "'>" + inside + "</link>";
}

inline std::string joint(const std::string& parent, const std::string& child, const std::string& type,
                         const std::string& xyz) {
  return "<joint name='" + parent + "_" + child + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/><origin xyz='" + xyz + "'/><axis xyz='0 0 1'/></joint>";
}

/// a –continuous– b –continuous– c –fixed– d, each a box of 0.1 m; a, b and c are 1 m apart along x, d 0.5
/// m farther.
inline std::string chain() {
  const std::string cube = box("0.1 0.1 0.1");
  return "<robot name='chain'>" + link("a", cube) + link("b", cube) + link("c", cube) + link("d", cube) +
         link("tool_frame") + joint("a", "b", "continuous", "1 0 0") + joint("b", "c", "continuous", "1 0 0") +
         joint("c", "d", "fixed", "0.5 0 0") + joint("d", "tool_frame", "fixed", "0 0 0") + "</robot>";
}

/// Why the plan leaves the pair out; "checked" if it does not.
inline std::string reasonFor(const SceneDescription& scene, const std::string& a, const std::string& b) {
  for (const PairDecision& pair : planScene(scene).left_out)
    if (namePair(pair.body_a, pair.body_b) == namePair(a, b)) return pair.text;
  return "checked";
}

struct Described {
  SceneDescription scene;
  std::vector<std::string> warnings;
};

inline Described describe(const std::string& urdf, const Srdf& srdf = {}, const RobotPairOptions& options = {}) {
  Described described;
  described.scene = describeRobot(RobotModel(urdf), srdf, loadOwn, options, described.warnings);
  return described;
}

}  // namespace sdf_ccd::test
