#include "joint_tree.h"

#include <algorithm>
#include <map>
#include <set>

#include <urdf_model/utils.h>

#include "common/shown_text.h"
#include "parse_urdf.h"
#include "readable_link.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMostLeaders = 100;  // all positions are computed through them, one after another

std::string attributeOf(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value ? value : "";
}

/// @param end  "parent" or "child".
std::string linkAt(const XMLElement& joint, const char* end) {
  const XMLElement* element = joint.FirstChildElement(end);
  return element ? attributeOf(*element, "link") : "";
}

std::string labelOf(const XMLElement& joint) {
  return "joint " + shownText(attributeOf(joint, "name"));
}

bool isNumber(const char* text) {
  try {
    urdf::strToDouble(text ? text : "");
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

void removeChildren(XMLElement& parent, const char* name) {
  while (XMLElement* child = parent.FirstChildElement(name)) parent.DeleteChild(child);
}

void addLink(XMLElement& joint, const char* end, const std::string& link) {
  XMLElement* element = joint.GetDocument()->NewElement(end);
  element->SetAttribute("link", link.c_str());
  joint.InsertEndChild(element);
}

/// Removes what nobody reads here, though the parser refuses a robot for it.
void removeUnread(XMLElement& joint) {
  for (const char* name : {"calibration", "dynamics", "safety_controller"}) removeChildren(joint, name);
  const std::string type = attributeOf(joint, "type");
  XMLElement* limit = joint.FirstChildElement("limit");
  if (!limit && (type == "revolute" || type == "prismatic"))
    limit = joint.InsertEndChild(joint.GetDocument()->NewElement("limit"))->ToElement();  // 0 to 0: there are none
  if (!limit) return;
  limit->SetAttribute("effort", "0");
  if (!isNumber(limit->Attribute("velocity"))) limit->SetAttribute("velocity", "0");
}

/// Why no position of the child follows from a joint and its position; empty if one does.
std::string whyNoKinematics(const XMLElement& joint) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  joint.Accept(&printer);
  std::string alone = "<robot name=\"joint\">";
  tinyxml2::XMLDocument document;
  for (const char* end : {"parent", "child"}) {
    XMLElement* link = document.NewElement("link");
    link->SetAttribute("name", linkAt(joint, end).c_str());
    tinyxml2::XMLPrinter of_link(nullptr, true);
    link->Accept(&of_link);
    alone += of_link.CStr();
  }
  const std::string errors = urdfErrors(alone + printer.CStr() + "</robot>");
  if (!errors.empty()) return "it cannot be read: " + errors;
  const std::string type = attributeOf(joint, "type");
  const XMLElement* axis = joint.FirstChildElement("axis");
  if (!axis || (type != "revolute" && type != "continuous" && type != "prismatic")) return {};
  urdf::Vector3 direction(1.0, 0.0, 0.0);
  if (const char* xyz = axis->Attribute("xyz")) direction.init(xyz);
  const bool is_null = direction.x == 0.0 && direction.y == 0.0 && direction.z == 0.0;
  return is_null ? "its axis is 0 0 0" : "";
}

void makeFloating(XMLElement& joint) {
  for (const char* name : {"axis", "limit", "mimic"}) removeChildren(joint, name);
  joint.SetAttribute("type", "floating");
  if (!whyNoKinematics(joint).empty()) removeChildren(joint, "origin");
}

class Tree {
 public:
  Tree(XMLElement& robot, std::vector<std::string>& warnings) : robot_(robot), warnings_(warnings) {}

  void mend() {
    nameLinks();
    for (XMLElement* joint = robot_.FirstChildElement("joint"); joint;) {
      XMLElement* next = joint->NextSiblingElement("joint");
      readJoint(*joint);
      joint = next;
    }
    for (const std::string& name : joints_) freeFromLeader(name);
    join();
    if (more_ > 0) warnings_.push_back("and " + std::to_string(more_) + " more joints or links like these");
  }

 private:
  void nameLinks() {
    for (XMLElement* link = robot_.FirstChildElement("link"); link;) {
      XMLElement* next = link->NextSiblingElement("link");
      const std::string name = linkName(*link);
      link->SetAttribute("name", name.c_str());
      if (known_.insert(name).second) {
        links_.push_back(name);
      } else {
        robot_.DeleteChild(link);  // ParsedUrdf::unread names it
      }
      link = next;
    }
  }

  /// Leads to each link by one chain of joints.
  void join() {
    std::map<std::string, std::vector<std::string>> below;
    for (const auto& [child, joint] : above_) below[linkAt(*joint, "parent")].push_back(child);
    std::set<std::string> reached;
    const auto reach = [&](const std::string& root) {
      std::vector<std::string> open = {root};
      std::size_t count = 0;
      for (; !open.empty(); ++count) {
        const std::string link = open.back();
        open.pop_back();
        reached.insert(link);
        for (const std::string& child : below[link])
          if (child != root) open.push_back(child);
      }
      return count;
    };
    std::vector<std::pair<std::string, std::size_t>> roots;  // with the number of links below them
    for (const std::string& link : links_)
      if (above_.count(link) == 0) roots.emplace_back(link, reach(link));
    for (const std::string& link : links_) {
      if (reached.count(link) > 0) continue;
      const std::string cut = inLoopAbove(link);
      XMLElement* joint = above_.at(cut);
      warn(labelOf(*joint) + " is left out: it closes a loop");
      above_.erase(cut);
      robot_.DeleteChild(joint);
      roots.emplace_back(cut, reach(cut));
    }
    const auto is_smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto largest = std::max_element(roots.begin(), roots.end(), is_smaller);  // the first of the largest
    for (auto root = roots.begin(); root != roots.end(); ++root)
      if (root != largest) addFloating(largest->first, root->first);
  }

  /// A link of the loop that the chain above this one ends in.
  std::string inLoopAbove(std::string link) const {
    std::set<std::string> seen;
    while (seen.insert(link).second) link = linkAt(*above_.at(link), "parent");
    return link;
  }

  void warn(const std::string& text) {
    constexpr std::size_t kMost = 20;
    if (warned_ < kMost) {
      ++warned_;
      warnings_.push_back(text);
    } else {
      ++more_;
    }
  }

  void readJoint(XMLElement& joint) {
    const std::string parent = linkAt(joint, "parent"), child = linkAt(joint, "child");
    nameJoint(joint, child);
    for (const auto& [end, link] : {std::pair("parent", parent), std::pair("child", child)}) {
      if (known_.count(link) > 0 && parent != child) continue;
      const std::string what = link.empty()      ? "it has no " + std::string(end) + " link"
                               : parent == child ? "it joins link " + shownText(link) + " to itself"
                                                 : "link " + shownText(link) + " does not exist";
      warn(labelOf(joint) + " is left out: " + what);
      robot_.DeleteChild(&joint);
      return;
    }
    const auto [above, is_first] = above_.emplace(child, &joint);
    if (!is_first) {
      warn("link " + shownText(child) + " is the child of two joints, " + attributeOf(*above->second, "name") +
           " and " + attributeOf(joint, "name") + kFloats);
      makeFloating(*above->second);
      robot_.DeleteChild(&joint);
      return;
    }
    removeUnread(joint);
    joints_.push_back(attributeOf(joint, "name"));
    by_name_[joints_.back()] = &joint;
    const std::string why = whyNoKinematics(joint);
    if (why.empty()) return;
    warn(labelOf(joint) + ": " + why + kFloats);
    makeFloating(joint);
  }

  /// Names are unique.
  void nameJoint(XMLElement& joint, const std::string& child) {
    std::string name = attributeOf(joint, "name");
    if (!name.empty() && names_.insert(name).second) return;
    const std::string renamed = freeName("joint of link " + child);
    warn("the joint above link " + shownText(child) +
         (name.empty() ? " has no name" : " has the name of another joint, " + shownText(name)) + ": it is named " +
         shownText(renamed));
    joint.SetAttribute("name", renamed.c_str());
  }

  std::string freeName(const std::string& wanted) {
    std::string name = wanted;
    while (!names_.insert(name).second) name += "'";
    return name;
  }

  void freeFromLeader(const std::string& name) {
    const std::string why = whyNoLeader(name);
    if (why.empty()) return;
    warn("joint " + shownText(name) + " mimics " + why + ": it is taken for a joint of its own");
    removeChildren(*by_name_.at(name), "mimic");
  }

  /// Why a joint that mimics another cannot follow it, after "mimics"; empty if it can.
  std::string whyNoLeader(const std::string& name) const {
    std::set<std::string> seen = {name};
    std::string follower = name;
    while (const XMLElement* mimic = by_name_.at(follower)->FirstChildElement("mimic")) {
      const std::string leader = attributeOf(*mimic, "joint");
      if (leader == name) return "itself";
      const auto found = by_name_.find(leader);
      const bool is_next = follower == name;  // otherwise it is the other follower's leader
      if (found == by_name_.end()) return is_next ? shownText(leader) + ", which does not exist" : "";
      const std::string type = attributeOf(*found->second, "type");
      if (type == "floating" || type == "planar") return is_next ? shownText(leader) + ", which has no position" : "";
      if (!seen.insert(leader).second) return {};  // a loop of others
      if (seen.size() > kMostLeaders)
        return "a joint that mimics another, and so on, more than " + std::to_string(kMostLeaders) + " times";
      follower = leader;
    }
    return {};
  }

  void addFloating(const std::string& root, const std::string& link) {
    warn("no chain of joints leads from the root link " + shownText(root) + " to link " + shownText(link) + kFloats);
    XMLElement* joint = robot_.GetDocument()->NewElement("joint");
    joint->SetAttribute("name", freeName("joint of link " + link).c_str());
    joint->SetAttribute("type", "floating");
    addLink(*joint, "parent", root);
    addLink(*joint, "child", link);
    robot_.InsertEndChild(joint);
  }

  static constexpr const char* kFloats = ": it is taken to float, so that it is where tf has it";

  XMLElement& robot_;
  std::vector<std::string>& warnings_;
  std::vector<std::string> links_, joints_;     // names, in the document's order
  std::set<std::string> known_, names_;         // of links, of joints
  std::map<std::string, XMLElement*> by_name_;  // joints
  std::map<std::string, XMLElement*> above_;    // the joint by its child link
  std::size_t warned_ = 0, more_ = 0;
};

}  // namespace

void makeTree(XMLElement& robot, std::vector<std::string>& warnings) {
  Tree(robot, warnings).mend();
}

}  // namespace sdf_ccd
