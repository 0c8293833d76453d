#include "robot/moveit_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "common/number_text.h"
#include "common/read_number.h"
#include "common/shown_text.h"

namespace sdf_ccd {
namespace {

constexpr int kMaxShapes = 10'000, kMaxCorners = 5'000'000;

/// Reads a text word by word and counts its lines.
class Words {
 public:
  explicit Words(const std::string& text) : stream_(text) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error("line " + std::to_string(line_) + ": " + reason);
  }

  /// The rest of the line, without blanks around it.
  std::string rest() {
    std::string text = words_.str().substr(std::min<std::size_t>(std::size_t(words_.tellg()), words_.str().size()));
    words_.setstate(std::ios::eofbit);
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
  }

  /// Skips a line, which may be blank. @return false at the end.
  bool skipLine() {
    std::string text;
    ++line_;
    return static_cast<bool>(std::getline(stream_, text));
  }

  /// Goes to the next line that is not blank, if this one is used up. @return false at the end.
  bool goOn() {
    while ((words_ >> std::ws).eof()) {
      std::string text;
      if (!std::getline(stream_, text)) return false;
      ++line_;
      words_.clear();
      words_.str(text);
    }
    return true;
  }

  /// Number of words left on this line, or on the next one if there are none.
  int count() {
    if (!goOn()) return 0;
    std::istringstream copy(words_.str().substr(std::size_t(words_.tellg())));
    int words = 0;
    for (std::string word; copy >> word;) ++words;
    return words;
  }

  std::string word() {
    if (!goOn()) fail("the text ends too early");
    std::string word;
    words_ >> word;
    return word;
  }

  double number() {
    const std::string text = word();
    const std::optional<double> value = wholeNumber(text);
    if (!value || !std::isfinite(*value)) fail("expected a number, not " + shownText(text));
    return *value;
  }
  double positive() {
    const double value = number();
    if (!(value > 0.0)) fail("a size must be positive");
    return value;
  }
  int whole(int most) {
    const double value = number();
    if (value != std::floor(value) || value < 0.0 || value > most)
      fail("expected an integer from 0 to " + std::to_string(most));
    return static_cast<int>(value);
  }
  Vector3d vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  Isometry3d pose() {
    const Vector3d p = vector();
    if (!isNearOrigin(p)) fail("a position more than " + numberText(kFarthestPose) + " m from the origin");
    const Vector3d axis = vector();
    Quaterniond q(number(), axis.x(), axis.y(), axis.z());
    constexpr double kRounded = 0.05;  // files written by hand have two digits
    if (std::abs(q.norm() - 1.0) < kRounded) q.normalize();
    const auto pose = poseOf(p, q);
    if (!pose) fail("expected a unit quaternion");
    return *pose;
  }

 private:
  std::istringstream stream_, words_;
  int line_ = 0;
};

TriangleMesh readMesh(Words& words) {
  TriangleMesh mesh;
  const int vertices = words.whole(kMaxCorners), triangles = words.whole(kMaxCorners);
  for (int i = 0; i < vertices; ++i) mesh.vertices.push_back(words.vector());
  for (int i = 0; i < triangles; ++i) {
    Vector3i corners;
    for (int k = 0; k < 3; ++k) {
      corners[k] = words.whole(kMaxCorners);
      if (corners[k] >= vertices)
        words.fail("a triangle has vertex " + std::to_string(corners[k]) + ", of " + std::to_string(vertices));
    }
    mesh.triangles.push_back(corners);
  }
  if (mesh.triangles.empty()) words.fail("a mesh without triangles");
  return mesh;
}

WorldShape readShape(Words& words) {
  WorldShape made;
  const std::string type = words.word();
  if (type == "box") {
    const double x = words.positive(), y = words.positive();
    made.shape = Primitive(Box::fromSize(Vector3d(x, y, words.positive())));
  } else if (type == "sphere") {
    made.shape = Primitive(Sphere{words.positive()});
  } else if (type == "cylinder") {
    const double radius = words.positive();
    made.shape = Primitive(Cylinder::fromRadiusAndLength(radius, words.positive()));
  } else if (type == "cone") {
    const double radius = words.positive();
    made.shape = coneShape(radius, words.positive());
  } else if (type == "plane") {
    const Vector3d normal = words.vector();
    const auto solid = solidBelow(normal, words.number());
    if (!solid) words.fail("a plane's normal is 0");
    made.shape = *solid;
  } else if (type == "mesh") {
    made.shape = std::make_shared<const TriangleMesh>(readMesh(words));
  } else {
    words.fail("a shape must be box, sphere, cylinder, cone, plane or mesh, not " + shownText(type));
  }
  made.X_BG = words.pose();
  for (int channel = 0; channel < 4; ++channel) words.number();  // its colour
  return made;
}

WorldObject readObject(Words& words) {
  WorldObject object;
  object.name = words.rest();
  if (object.name.empty() || object.name != shownText(object.name)) words.fail("expected an object's name after *");
  const bool has_pose = words.count() == 3;  // else the number of shapes
  if (has_pose) object.X_frame_B = words.pose();
  const int shapes = words.whole(kMaxShapes);
  if (shapes == 0) words.fail("object " + object.name + " has no shapes");
  for (int i = 0; i < shapes; ++i) object.shapes.push_back(readShape(words));
  if (!has_pose) return object;
  for (int subframes = words.whole(kMaxShapes); subframes > 0; --subframes) {
    if (!words.goOn()) words.fail("the text ends too early");
    words.rest();  // its name
    words.pose();
  }
  return object;
}

}  // namespace

std::vector<WorldObject> parseMoveitScene(const std::string& text) {
  Words words(text);
  std::vector<WorldObject> objects;
  if (!words.skipLine()) words.fail("it is empty");  // the scene's name, which may be empty
  for (;;) {
    if (!words.goOn()) words.fail("the text ends too early: its last line must be a dot");
    const std::string mark = words.word();
    if (mark == ".") return objects;
    if (mark != "*") words.fail("expected * and an object's name, or a last line with a dot, not " + shownText(mark));
    if (objects.size() == kMaxObjects) words.fail("more than " + std::to_string(kMaxObjects) + " objects");
    objects.push_back(readObject(words));
  }
}

}  // namespace sdf_ccd
