#include "mesh_formats.h"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

#include <tinyxml2.h>

#include "collada_mesh.h"
#include "common/pi.h"
#include "common/read_number.h"
#include "xml_numbers.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

constexpr int kMaxNodes = 20'000;  // after instances are expanded
constexpr int kMaxDepth = 1000;

/// The next element in document order, below `root`.
const XMLElement* next(const XMLElement* element, const XMLElement* root) {
  if (const XMLElement* child = element->FirstChildElement()) return child;
  while (element != root) {
    if (const XMLElement* sibling = element->NextSiblingElement()) return sibling;
    element = element->Parent()->ToElement();
  }
  return nullptr;
}

std::vector<double> exactly(std::size_t count, const XMLElement& element) {
  std::vector<double> numbers = numbersOf(element);
  if (numbers.size() == count) return numbers;
  throw std::runtime_error(describe(element) + " holds " + std::to_string(numbers.size()) + " numbers, not " +
                           std::to_string(count));
}

Eigen::Affine3d lookAt(const XMLElement& element) {
  const std::vector<double> n = exactly(9, element);
  const Vector3d eye(n[0], n[1], n[2]), target(n[3], n[4], n[5]), up(n[6], n[7], n[8]);
  const Vector3d back = (eye - target).normalized(), across = up.normalized().cross(back), right = across.normalized();
  if (!(across.norm() > 1e-6)) {
    throw std::runtime_error(describe(element) + " has no direction, or one along its own up-axis");
  }
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  X.linear() << right, back.cross(right), back;
  X.translation() = eye;
  return X;
}

/// The transform of one child of a node; identity if the child is no transform.
Eigen::Affine3d transformOf(const XMLElement& element) {
  const std::string_view name = element.Name();
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  if (name == "matrix") {
    const std::vector<double> n = exactly(16, element);
    if (n[12] != 0.0 || n[13] != 0.0 || n[14] != 0.0 || n[15] != 1.0) {
      throw std::runtime_error(describe(element) + " is projective: its last row is not 0 0 0 1");
    }
    X.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(n.data());
  } else if (name == "translate") {
    X.translation() = Vector3d(exactly(3, element).data());
  } else if (name == "scale") {
    X.linear().diagonal() = Vector3d(exactly(3, element).data());
  } else if (name == "rotate") {
    const std::vector<double> n = exactly(4, element);
    const Vector3d axis(n[0], n[1], n[2]);
    if (axis.norm() > 0.0) X.linear() = Eigen::AngleAxisd(n[3] * kPi / 180.0, axis.normalized()).toRotationMatrix();
  } else if (name == "lookat") {
    X = lookAt(element);
  } else if (name == "skew") {
    throw std::runtime_error(describe(element) + ": skewed nodes (<skew>) are not supported");
  }
  return X;
}

/// Collects the meshes of a scene's nodes.
class SceneReader {
 public:
  explicit SceneReader(const XMLElement& root) {
    for (const XMLElement* element = &root; element; element = next(element, &root)) {
      const std::string id = attributeOf(*element, "id");
      if (!id.empty()) by_id_.emplace(id, element);
    }
  }

  TriangleMesh read(const XMLElement& root) {
    const XMLElement* scene = root.FirstChildElement("scene");
    const XMLElement* instance = scene ? scene->FirstChildElement("instance_visual_scene") : nullptr;
    if (!instance) throw std::runtime_error("it has no <scene>");
    const XMLElement& top = *target(*instance, "url", "visual_scene");
    const Expansion expansion = expansionOf(top);
    if (expansion.nodes > kMaxNodes) {
      throw std::runtime_error("it has more than " + std::to_string(kMaxNodes) + " nodes once instances are followed");
    }
    if (expansion.depth > kMaxDepth) refuseDepth();
    addNode(top, Eigen::Affine3d::Identity());
    return std::move(result_);
  }

 private:
  const XMLElement* target(const XMLElement& from, const char* attribute, const char* kind) const {
    const std::string id = referenceOf(from, attribute);
    const auto found = by_id_.find(id);
    if (found != by_id_.end() && std::string(found->second->Name()) == kind) return found->second;
    throw std::runtime_error(describe(from) + " refers to \"#" + id.substr(0, 80) + "\", which is no <" + kind + ">");
  }

  /// A node and all below it, once instances are followed.
  struct Expansion {
    int nodes = 1;  ///< at most one more than is read
    int depth = 1;
  };

  [[noreturn]] static void refuseDepth() {
    throw std::runtime_error("nodes are more than " + std::to_string(kMaxDepth) + " deep");
  }

  /// The child's node, if it is one or refers to one; else null.
  const XMLElement* nodeOf(const XMLElement& child) const {
    const std::string_view name = child.Name();
    if (name == "node") return &child;
    return name == "instance_node" ? target(child, "url", "node") : nullptr;
  }

  /// Looks at each node once, however often it is expanded.
  Expansion expansionOf(const XMLElement& node) {
    if (const auto known = expansions_.find(&node); known != expansions_.end()) return known->second;
    if (!open_.insert(&node).second) {
      throw std::runtime_error("the node \"" + attributeOf(node, "id") + "\" contains itself");
    }
    if (open_.size() > kMaxDepth) refuseDepth();
    Expansion all;
    for (const XMLElement* child = node.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const XMLElement* below = nodeOf(*child);
      if (!below) continue;
      const Expansion expansion = expansionOf(*below);
      all.nodes = std::min(all.nodes + expansion.nodes, kMaxNodes + 1);
      all.depth = std::max(all.depth, expansion.depth + 1);
    }
    open_.erase(&node);
    return expansions_[&node] = all;
  }

  /// @param X  transform of the parent node.
  void addNode(const XMLElement& node, Eigen::Affine3d X) {
    // A node's transforms apply to all of its other children, so they are gathered first.
    for (const XMLElement* child = node.FirstChildElement(); child; child = child->NextSiblingElement()) {
      X = X * transformOf(*child);
    }
    for (const XMLElement* child = node.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (const XMLElement* below = nodeOf(*child)) addNode(*below, X);
      if (name == "instance_geometry") addGeometry(*target(*child, "url", "geometry"), X);
      if (name == "instance_controller") addController(*target(*child, "url", "controller"), X);
    }
  }

  void addController(const XMLElement& controller, const Eigen::Affine3d& X) {
    const XMLElement* skin = controller.FirstChildElement("skin");
    const XMLElement* shape = skin ? skin : controller.FirstChildElement("morph");
    if (shape) addGeometry(*target(*shape, "source", "geometry"), X);
  }

  void addGeometry(const XMLElement& geometry, const Eigen::Affine3d& X) {
    const XMLElement* element = geometry.FirstChildElement("mesh");
    if (!element) return;
    const auto [found, is_new] = meshes_.try_emplace(&geometry);
    if (is_new) found->second = colladaMesh(*element);
    const TriangleMesh& mesh = found->second;
    if (result_.vertices.size() + mesh.vertices.size() > std::numeric_limits<int>::max()) {
      throw std::runtime_error("more than 2^31 vertices");
    }
    const Vector3i offset = Vector3i::Constant(static_cast<int>(result_.vertices.size()));
    const bool mirrored = X.linear().determinant() < 0;
    for (const Vector3d& v : mesh.vertices) result_.vertices.push_back(X * v);
    for (Vector3i t : mesh.triangles) {
      if (mirrored) std::swap(t[1], t[2]);
      result_.triangles.emplace_back(t + offset);
    }
  }

  std::map<std::string, const XMLElement*> by_id_;
  std::map<const XMLElement*, TriangleMesh> meshes_;   // of geometries, each read once
  std::map<const XMLElement*, Expansion> expansions_;  // of nodes
  std::set<const XMLElement*> open_;                   // nodes from the root to the one whose expansion is sought
  TriangleMesh result_;
};

/// Metres per unit; 1 if the file has no `<unit meter>`.
double meterOf(const XMLElement& root) {
  const XMLElement* asset = root.FirstChildElement("asset");
  const XMLElement* unit = asset ? asset->FirstChildElement("unit") : nullptr;
  const char* text = unit ? unit->Attribute("meter") : nullptr;
  if (!text) return 1;
  const std::optional<double> meter = wholeNumber(text);
  if (!meter || !std::isfinite(*meter) || *meter <= 0) {
    throw std::runtime_error("unit meter=\"" + std::string(text) + "\" is not a positive number");
  }
  return *meter;
}

}  // namespace

TriangleMesh parseDae(const std::string& bytes) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("not well-formed XML near line " + std::to_string(document.ErrorLineNum()));
  }
  const XMLElement* root = document.RootElement();
  if (!root) throw std::runtime_error("an XML document without elements");
  const double meter = meterOf(*root);
  TriangleMesh mesh = SceneReader(*root).read(*root);
  for (Vector3d& v : mesh.vertices) v *= meter;
  return mesh;
}

}  // namespace sdf_ccd
