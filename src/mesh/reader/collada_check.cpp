#include "collada_check.h"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "common/read_number.h"
#include "text_words.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;
using Names = std::set<std::string_view>;

std::string attributeOf(const XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  return text ? text : "";
}

[[noreturn]] void fail(const XMLElement& element, const std::string& what) {
  throw std::runtime_error("<" + std::string(element.Name()) + "> near line " + std::to_string(element.GetLineNum()) +
                           " " + what);
}

/// Of up to 30 bits.
bool isIndex(std::string_view word) {
  return word.size() < 10 && word.find_first_not_of("0123456789") == std::string_view::npos;
}

bool isNumber(std::string_view word) {
  return takeNumber(word).has_value();
}

/// assimp repeats an index that is no number without end, takes a negative one, or one of more than 31 bits, for
/// another, and goes on within a word after what it takes for a number.
std::size_t countWords(bool (*is_valid)(std::string_view), const XMLElement& element) {
  std::size_t count = 0;
  std::string_view text = element.GetText() ? element.GetText() : "";
  for (std::string_view word = takeWord(text); !word.empty(); word = takeWord(text)) {
    if (!is_valid(word)) fail(element, "holds \"" + std::string(word.substr(0, 20)) + "\" among its numbers");
    ++count;
  }
  return count;
}

/// assimp scales by an axis of another length. @param rotate  holds four numbers.
void requireAxis(const XMLElement& rotate) {
  std::string_view text = rotate.GetText();
  double numbers[4];
  for (double& number : numbers) number = *takeNumber(text);
  const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
  if (numbers[3] != 0.0 && !(std::abs(length - 1.0) < 1e-3)) fail(rotate, "turns about an axis that has not length 1");
}

class Inspector : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const XMLElement& element, const tinyxml2::XMLAttribute*) override {
    const std::string_view name = element.Name();
    if (name == "extra") return false;  // of any content
    const std::string id = "#" + attributeOf(element, "id");
    targets_.insert("instance_" + std::string(name) + id);
    if (Names{"ph", "skew", "trifans"}.count(name) > 0) fail(element, "is not supported");
    if (Names{"instance_node", "instance_geometry", "instance_controller"}.count(name) > 0)
      instances_.push_back(&element);
    if (name == "node") nodes_[id] = &element;
    if (name == "visual_scene") scenes_.push_back(&element);
    if (name == "float_array") lengths_[id] = element.DoubleAttribute("count");
    if (name == "accessor") accessors_.push_back(&element);
    if (name == "input" && attributeOf(element, "semantic") == "POSITION") {
      positions_.insert(attributeOf(element, "source"));
    }
    static const std::map<std::string_view, std::size_t> transforms = {
        {"matrix", 16}, {"translate", 3}, {"rotate", 4}, {"scale", 3}, {"lookat", 9}};
    if (Names{"p", "vcount"}.count(name) > 0) countWords(isIndex, element);
    if (name == "float_array") countWords(isNumber, element);
    if (const auto t = transforms.find(name); t != transforms.end() && countWords(isNumber, element) != t->second) {
      fail(element, "has not " + std::to_string(t->second) + " numbers");
    }
    if (name == "rotate") requireAxis(element);
    for (const char* number : {"count", "offset", "stride"}) {
      if (!isIndex(attributeOf(element, number))) fail(element, std::string("has no number as its ") + number);
    }
    const XMLElement* parent = element.Parent()->ToElement();
    if (name == "p" && element.GetText() && parent && parent->IntAttribute("count") <= 0) {
      fail(*parent, "announces no elements, but has some");
    }
    return true;
  }

  /// To be called once all elements have been visited.
  void finish() const {
    for (const XMLElement* instance : instances_) {
      const std::string url = attributeOf(*instance, "url");
      if (url.size() < 2 || targets_.count(instance->Name() + url) == 0) {
        fail(*instance, "refers to \"" + url.substr(0, 80) + "\", which is not in the file");
      }
    }
    for (const XMLElement* accessor : accessors_) requireNumbers(*accessor);
    std::map<const XMLElement*, double> below;
    for (const XMLElement* scene : scenes_) countNodes(*scene, below);
  }

 private:
  /// Nodes below one, each instance for itself, as assimp makes them. @param below  known ones; negative: being
  /// counted.
  double countNodes(const XMLElement& node, std::map<const XMLElement*, double>& below) const {
    constexpr double kMost = 1e5;
    const auto [known, is_new] = below.emplace(&node, -1.0);
    if (known->second < 0.0 && !is_new) fail(node, "contains itself");
    if (!is_new) return known->second;
    double count = 0.0;
    for (const auto* child = node.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      const auto target = name == "instance_node" ? nodes_.find(attributeOf(*child, "url")) : nodes_.end();
      if (name == "node") count += 1.0 + countNodes(*child, below);
      if (target != nodes_.end()) count += 1.0 + countNodes(*target->second, below);
      if (count > kMost) fail(node, "has more than 100,000 nodes below it");
    }
    return below[&node] = count;
  }

  void requireNumbers(const XMLElement& accessor) const {
    const auto array = lengths_.find(attributeOf(accessor, "source"));
    if (array == lengths_.end()) return;  // not of numbers, or assimp says that it is missing
    int parameters = 0;
    std::set<std::string> names;
    for (const auto* p = accessor.FirstChildElement("param"); p; p = p->NextSiblingElement("param")) {
      names.insert(attributeOf(*p, "name"));
      ++parameters;
    }
    const tinyxml2::XMLNode* above = accessor.Parent()->Parent();
    const XMLElement* source = above ? above->ToElement() : nullptr;
    const bool is_position = source && positions_.count("#" + attributeOf(*source, "id")) > 0;
    if (is_position && names.count("X") + names.count("Y") + names.count("Z") < 3) {
      fail(accessor, "names no X, Y and Z");
    }
    const double stride = accessor.DoubleAttribute("stride", 1.0);
    const double end = accessor.DoubleAttribute("offset") + stride * accessor.DoubleAttribute("count");
    if (parameters > stride || end > array->second) fail(accessor, "reads beyond the numbers of its source");
  }

  std::set<std::string> targets_, positions_;
  std::vector<const XMLElement*> instances_, accessors_, scenes_;
  std::map<std::string, const XMLElement*> nodes_;  // by "#" and their id
  std::map<std::string, double> lengths_;           // announced numbers of arrays, which assimp requires to be there
};

}  // namespace

double checkCollada(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("not well-formed XML near line " + std::to_string(document.ErrorLineNum()));
  }
  Inspector inspector;
  document.Accept(&inspector);
  inspector.finish();
  const XMLElement* root = document.RootElement();
  const XMLElement* asset = root ? root->FirstChildElement("asset") : nullptr;
  const XMLElement* unit = asset ? asset->FirstChildElement("unit") : nullptr;
  const char* text = unit ? unit->Attribute("meter") : nullptr;
  if (!text) return 1.0;
  const std::optional<double> meter = wholeNumber(text);
  if (!meter || !std::isfinite(*meter) || *meter <= 0.0) {
    throw std::runtime_error("unit meter=\"" + std::string(text) + "\" is not a positive number");
  }
  return *meter;
}

}  // namespace sdf_ccd
