#include <stdexcept>

#include <fmt/format.h>

#include "common/shown_text.h"
#include "robot/moveit_scene.h"

namespace sdf_ccd {
namespace {

std::string numbers(const Vector3d& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string poseLines(const Isometry3d& X) {
  const Quaterniond q = Quaterniond(X.linear()).normalized();
  return numbers(X.translation()) + fmt::format("\n{:.17g} {:.17g} {:.17g} {:.17g}\n", q.x(), q.y(), q.z(), q.w());
}

struct PrimitiveLines {
  std::string operator()(const Sphere& sphere) const { return fmt::format("sphere\n{:.17g}\n", sphere.radius); }
  std::string operator()(const Box& box) const { return "box\n" + numbers(box.size) + "\n"; }
  std::string operator()(const Cylinder& cylinder) const {
    return fmt::format("cylinder\n{:.17g} {:.17g}\n", cylinder.radius, cylinder.length);
  }
  std::string operator()(const HalfSpace& half_space) const {
    return "plane\n" + numbers(half_space.normal) + fmt::format(" {:.17g}\n", -half_space.offset);
  }
};

std::string meshLines(const TriangleMesh& mesh) {
  std::string text = fmt::format("mesh\n{} {}\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vector3d& vertex : mesh.vertices) text += numbers(vertex) + "\n";
  for (const Vector3i& corners : mesh.triangles) text += fmt::format("{} {} {}\n", corners[0], corners[1], corners[2]);
  return text;
}

}  // namespace

bool isSavedName(const std::string& name) {
  return !name.empty() && name.front() != ' ' && name.back() != ' ' && name == shownText(name, name.size());
}

std::string moveitScene(const std::vector<BodyDescription>& bodies) {
  std::string text = "sdf_ccd\n";
  for (const BodyDescription& body : bodies) {
    if (!isSavedName(body.name))
      throw std::invalid_argument(
          "object '" + shownText(body.name) +
          "' cannot be saved: its name begins or ends with a blank, or contains control characters");
    text += "* " + body.name + "\n" + poseLines(body.X_frame_B) + std::to_string(body.geometry.size()) + "\n";
    for (const GeometryDescription& geometry : body.geometry) {
      const auto* primitive = std::get_if<Primitive>(&geometry.shape);
      text += primitive ? std::visit(PrimitiveLines(), *primitive)
                        : meshLines(*std::get<std::shared_ptr<const TriangleMesh>>(geometry.shape));
      text += poseLines(geometry.X_BG) + "0 0 0 0\n";
    }
    text += "0\n";  // subframes
  }
  return text + ".\n";
}

}  // namespace sdf_ccd
