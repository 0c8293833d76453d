#include "dynamics/scene_settings.h"

#include "common/number_text.h"
#include "motion/valid_pose.h"

namespace sdf_ccd {

std::optional<Primitive> readPrimitive(SettingsReader& shape, const std::string& type) {
  if (type == "box") {
    const Vector3d size = shape.vector("size");
    if (!(size.minCoeff() > 0.0)) shape.fail("size", "three positive numbers");
    return Box::fromSize(size);
  }
  if (type == "sphere") return Sphere{shape.positive("radius")};
  if (type == "cylinder") return Cylinder::fromRadiusAndLength(shape.positive("radius"), shape.positive("length"));
  if (type == "plane") return HalfSpace{Vector3d::UnitZ(), 0.0};
  return std::nullopt;
}

void requireNear(const SettingsReader& reader, const std::string& key, const Vector3d& p) {
  if (!isNearOrigin(p)) reader.fail(key, "a position at most " + numberText(kFarthestPose) + " m from the origin");
}

Isometry3d readPose(SettingsReader& reader) {
  const Vector3d xyz = reader.vector("xyz", Vector3d::Zero()), rpy = reader.vector("rpy", Vector3d::Zero());
  requireNear(reader, "xyz", xyz);
  return Eigen::Translation3d(xyz) * Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) * Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX());
}

ContactOptions readContact(SettingsReader& contact) {
  ContactOptions options;
  options.stiffness_per = contact.choice("stiffness_per", {"area", "point"}, options.stiffness_per);
  options.stiffness = contact.notNegative("stiffness", options.stiffness);
  options.damping = contact.notNegative("damping", options.damping);
  options.normal = contact.choice("normal", {"field", "shell"}, options.normal);
  options.quadrature = contact.choice("quadrature", {"exact", "midpoint"}, options.quadrature);
  options.midpoint_intervals = contact.integer("midpoint_intervals", options.midpoint_intervals, 1, 10'000);
  return options;
}

}  // namespace sdf_ccd
