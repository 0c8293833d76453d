#include "ros/parameters/world_parameters.h"

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

constexpr double kUnset = -1.0;  // rejected by positive(): sizes have no default

std::string required(ParameterReader& reader, const std::string& key) {
  const std::string value = reader.text(key, "");
  if (value.empty()) reader.fail(key, "a string");
  return value;
}

WorldObject readObject(ParameterReader& reader) {
  WorldObject object;
  object.name = reader.name("name", "");
  if (object.name.empty()) reader.fail("name", "a string");
  object.frame = reader.name("frame", "");
  object.X_frame_B = readPose(reader);
  WorldShape& made = object.shapes.emplace_back();
  switch (reader.choice("type", {"box", "sphere", "cylinder", "plane", "mesh", "cone"}, -1)) {
    case 0: {
      const Vector3d size = reader.vector("size", Vector3d::Zero());
      if (!(size.minCoeff() > 0.0)) reader.fail("size", "three positive numbers");
      made.shape = Primitive(Box{0.5 * size});
      break;
    }
    case 1:
      made.shape = Primitive(Sphere{reader.positive("radius", kUnset)});
      break;
    case 2:
      made.shape = Primitive(Cylinder{reader.positive("radius", kUnset), 0.5 * reader.positive("length", kUnset)});
      break;
    case 3:
      made.shape = Primitive(HalfSpace{Vector3d::UnitZ(), 0.0});
      break;
    case 4: {
      const Vector3d scale = reader.vector("scale", Vector3d::Ones());
      if (scale.cwiseAbs().minCoeff() == 0.0) reader.fail("scale", "three numbers, none of them 0");
      made.shape = MeshObject{required(reader, "uri"), scale};
      break;
    }
    case 5: {
      const double radius = reader.positive("radius", kUnset);
      made.shape = coneShape(radius, reader.positive("length", kUnset));
      break;
    }
    default:
      reader.fail("type", "one of box sphere cylinder plane mesh cone");
  }
  reader.finish();
  return object;
}

/// Numbers of a message, given by name or as a list.
std::vector<double> fields(ParameterReader& reader, const std::string& key, const std::vector<std::string>& names,
                           const std::vector<double>& otherwise) {
  if (!reader.has(key)) return otherwise;
  if (!reader.isGroup(key)) return reader.numbers(key, names.size(), names.size());
  ParameterReader group = reader.group(key);
  std::vector<double> values;
  for (std::size_t i = 0; i < names.size(); ++i) values.push_back(group.number(names[i], otherwise[i]));
  return values;
}

void requireNear(const ParameterReader& reader, const std::string& key, const Vector3d& p) {
  if (!isNearOrigin(p)) reader.fail(key, "a position at most " + numberText(kFarthestPose) + " m from the origin");
}

Isometry3d messagePose(ParameterReader& reader) {
  const std::vector<double> p = fields(reader, "position", {"x", "y", "z"}, {0.0, 0.0, 0.0});
  const std::vector<double> q = fields(reader, "orientation", {"x", "y", "z", "w"}, {0.0, 0.0, 0.0, 1.0});
  requireNear(reader, "position", {p[0], p[1], p[2]});
  const auto pose = poseOf({p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]});
  if (!pose) reader.fail("orientation", "a unit quaternion");
  return *pose;
}

WorldShape::Shape messagePrimitive(ParameterReader& reader) {
  const int number = reader.isText("type") ? 1 + reader.choice("type", {"box", "sphere", "cylinder", "cone"}, -1)
                                           : reader.integer("type", 0, 0);
  if (!isSolidType(number)) reader.fail("type", "a box, sphere, cylinder or cone");
  const auto type = static_cast<SolidType>(number);
  const std::vector<double> size = reader.numbers("dimensions", dimensionsOf(type), dimensionsOf(type));
  for (const double length : size)
    if (!(length > 0.0)) reader.fail("dimensions", "positive numbers");
  return solidShape(type, size);
}

Primitive messagePlane(ParameterReader& reader) {
  const std::vector<double> coef = reader.numbers("coef", 4, 4);  // a x + b y + c z + d = 0
  const auto solid = solidBelow({coef[0], coef[1], coef[2]}, coef[3]);
  if (!solid) reader.fail("coef", "a normal that is not 0");
  return *solid;
}

MeshObject messageMesh(ParameterReader& reader) {
  // Only files are supported: nobody writes vertices and triangles in YAML by hand, and tools name a file.
  const std::vector<double> scale =
      reader.has("dimensions") ? reader.numbers("dimensions", 3, 3) : std::vector<double>{1.0, 1.0, 1.0};
  for (const double s : scale)
    if (s == 0.0) reader.fail("dimensions", "three numbers, none of them 0");
  return {required(reader, "resource"), {scale[0], scale[1], scale[2]}};
}

WorldObject collisionObject(ParameterReader& reader) {
  WorldObject object;
  object.name = reader.name("id", "");
  if (object.name.empty()) reader.fail("id", "a string");
  if (reader.has("header")) object.frame = reader.group("header").name("frame_id", "");
  if (reader.isText("operation")) {
    reader.choice("operation", {"ADD", "add"}, 0);
  } else if (reader.integer("operation", 0, 0) != 0) {
    reader.fail("operation", "ADD, 0");
  }
  if (reader.has("pose")) {
    ParameterReader pose = reader.group("pose");
    object.X_frame_B = messagePose(pose);
  }
  const auto add = [&](const std::string& key, const std::string& poses_key, const auto& shapeOf) {
    std::vector<ParameterReader> shapes = reader.list(key), poses = reader.list(poses_key);
    if (!poses.empty() && poses.size() != shapes.size())
      reader.fail(poses_key, std::to_string(shapes.size()) + " poses, as there are " + key);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      object.shapes.push_back({shapeOf(shapes[i]), poses.empty() ? Isometry3d::Identity() : messagePose(poses[i])});
  };
  add("primitives", "primitive_poses", messagePrimitive);
  add("planes", "plane_poses", messagePlane);
  add("meshes", "mesh_poses", messageMesh);
  if (object.shapes.empty()) reader.fail("primitives", "one or more primitives, planes or meshes");
  return object;
}

}  // namespace

Isometry3d readPose(ParameterReader& reader) {
  const Vector3d xyz = reader.vector("xyz", Vector3d::Zero()), rpy = reader.vector("rpy", Vector3d::Zero());
  requireNear(reader, "xyz", xyz);
  return Eigen::Translation3d(xyz) * Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) * Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX());
}

std::vector<WorldObject> readWorld(ParameterReader& reader) {
  std::vector<WorldObject> objects;
  if (reader.isGroup("world")) {
    ParameterReader world = reader.group("world");
    if (!world.has("collision_objects")) world.fail("collision_objects", "a list of MoveIt's collision objects");
    for (ParameterReader& object : world.list("collision_objects")) objects.push_back(collisionObject(object));
  } else {
    for (ParameterReader& object : reader.list("world")) objects.push_back(readObject(object));
  }
  return objects;
}

}  // namespace sdf_ccd
