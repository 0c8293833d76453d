#include "ros/parameters/world_parameters.h"

#include "dynamics/scene_settings.h"

namespace sdf_ccd {
namespace {

Vector3d readScale(SettingsReader& reader, const std::string& key) {
  const Vector3d scale = reader.vector(key, Vector3d::Ones());
  if (scale.cwiseAbs().minCoeff() == 0.0) reader.fail(key, "three numbers, none of them 0");
  return scale;
}

WorldObject readObject(SettingsReader& reader) {
  WorldObject object;
  object.name = reader.name("name");
  object.frame = reader.name("frame", "");
  object.X_frame_B = readPose(reader);
  WorldShape& made = object.shapes.emplace_back();
  const std::string type = reader.text("type", "");
  if (const auto primitive = readPrimitive(reader, type)) {
    made.shape = *primitive;
  } else if (type == "mesh") {
    made.shape = MeshObject{reader.text("uri"), readScale(reader, "scale")};
  } else if (type == "cone") {
    const double radius = reader.positive("radius");
    made.shape = coneShape(radius, reader.positive("length"));
  } else {
    reader.fail("type", "one of box sphere cylinder plane mesh cone");
  }
  reader.finish();
  return object;
}

/// Numbers of a message, given by name or as a list.
std::vector<double> fields(SettingsReader& reader, const std::string& key, const std::vector<std::string>& names,
                           const std::vector<double>& otherwise) {
  if (!reader.has(key)) return otherwise;
  if (!reader.isGroup(key)) return reader.numbers(key, names.size());
  SettingsReader group = reader.group(key);
  std::vector<double> values;
  for (std::size_t i = 0; i < names.size(); ++i) values.push_back(group.number(names[i], otherwise[i]));
  return values;
}

Isometry3d messagePose(SettingsReader& reader) {
  const std::vector<double> p = fields(reader, "position", {"x", "y", "z"}, {0.0, 0.0, 0.0});
  const std::vector<double> q = fields(reader, "orientation", {"x", "y", "z", "w"}, {0.0, 0.0, 0.0, 1.0});
  requireNear(reader, "position", {p[0], p[1], p[2]});
  const auto pose = poseOf({p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]});
  if (!pose) reader.fail("orientation", "a unit quaternion, w: 1 for no rotation");
  return *pose;
}

WorldShape::Shape messagePrimitive(SettingsReader& reader) {
  const int number = reader.isText("type") ? 1 + reader.choice("type", {"box", "sphere", "cylinder", "cone"})
                                           : reader.integer("type", 0, 0);
  if (!isSolidType(number)) reader.fail("type", "a box, sphere, cylinder or cone");
  const auto type = static_cast<SolidType>(number);
  const std::vector<double> size = reader.numbers("dimensions", dimensionsOf(type));
  for (const double length : size)
    if (!(length > 0.0)) reader.fail("dimensions", "positive numbers");
  return solidShape(type, size);
}

Primitive messagePlane(SettingsReader& reader) {
  const std::vector<double> coef = reader.numbers("coef", 4);  // a x + b y + c z + d = 0
  const auto solid = solidBelow({coef[0], coef[1], coef[2]}, coef[3]);
  if (!solid) reader.fail("coef", "a normal that is not 0");
  return *solid;
}

MeshObject messageMesh(SettingsReader& reader) {
  // Only files are supported: nobody writes vertices and triangles in YAML by hand, and tools name a file.
  return {reader.text("resource"), readScale(reader, "dimensions")};
}

WorldObject collisionObject(SettingsReader& reader) {
  WorldObject object;
  object.name = reader.name("id");
  if (reader.has("header")) object.frame = reader.group("header").name("frame_id", "");
  if (reader.isText("operation")) {
    reader.choice("operation", {"ADD", "add"}, 0);
  } else if (reader.integer("operation", 0, 0) != 0) {
    reader.fail("operation", "ADD, 0");
  }
  if (reader.has("pose")) {
    SettingsReader pose = reader.group("pose");
    object.X_frame_B = messagePose(pose);
  }
  const auto add = [&](const std::string& key, const std::string& poses_key, const auto& shapeOf) {
    std::vector<SettingsReader> shapes = reader.list(key), poses = reader.list(poses_key);
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

std::vector<WorldObject> readWorld(SettingsReader& reader) {
  std::vector<WorldObject> objects;
  if (reader.isGroup("world")) {
    SettingsReader world = reader.group("world");
    if (!world.has("collision_objects")) world.fail("collision_objects", "a list of MoveIt's collision objects");
    for (SettingsReader& object : world.list("collision_objects")) objects.push_back(collisionObject(object));
  } else {
    for (SettingsReader& object : reader.list("world")) objects.push_back(readObject(object));
  }
  return objects;
}

}  // namespace sdf_ccd
