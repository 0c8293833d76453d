#include "parse_urdf.h"

#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include "common/number_text.h"
#include "common/text_limits.h"
#include "empty_visuals.h"
#include "joint_kind.h"
#include "misplaced_elements.h"
#include "unexpanded_macros.h"
#include "xml_error.h"

namespace sdf_ccd {
namespace {

/// Collects this thread's console_bridge messages during its lifetime; forwards those of other threads (tf2 logs too).
class MessageCollector : public console_bridge::OutputHandler {
 public:
  MessageCollector() : previous_(console_bridge::getOutputHandler()), thread_(std::this_thread::get_id()) {
    console_bridge::useOutputHandler(this);
  }
  ~MessageCollector() override { console_bridge::useOutputHandler(previous_); }
  MessageCollector(const MessageCollector&) = delete;
  MessageCollector& operator=(const MessageCollector&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* file, int line) override {
    if (std::this_thread::get_id() != thread_) {
      if (previous_) previous_->log(text, level, file, line);
    } else if (level == console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      errors_ += (errors_.empty() ? "" : "; ") + text;
    }
  }

  const std::string& errors() const { return errors_; }

 private:
  console_bridge::OutputHandler* previous_;
  std::thread::id thread_;
  std::string errors_;
};

std::mutex handler_mutex;  // one output handler for the whole process

/// The document as written by tinyxml2, because urdfdom's XML reader reads beyond the end of some damaged documents;
/// and without empty visuals.
std::string wellFormed(const std::string& xml, std::vector<std::string>& warnings) {
  requireXmlSize(xml);
  const std::string text = soundText(xml);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) throw std::runtime_error(xmlError(document));
  if (const std::string macros = unexpandedMacros(document, "URDF"); !macros.empty()) warnings.push_back(macros);
  if (tinyxml2::XMLElement* robot = document.FirstChildElement("robot")) {
    const std::vector<std::string> misplaced = misplacedElements(*robot);
    warnings.insert(warnings.end(), misplaced.begin(), misplaced.end());
    for (auto link = robot->FirstChildElement("link"); link; link = link->NextSiblingElement("link"))
      removeEmptyVisuals(*link);
  }
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  return printer.CStr();
}

std::shared_ptr<urdf::ModelInterface> parse(const std::string& xml, std::vector<std::string>& warnings) {
  const std::lock_guard<std::mutex> lock(handler_mutex);
  MessageCollector collector;
  std::shared_ptr<urdf::ModelInterface> model;
  try {
    model = urdf::parseURDF(wellFormed(xml, warnings));
  } catch (const std::exception& error) {
    const std::string errors = collector.errors().empty() ? "" : collector.errors() + "; ";
    throw std::runtime_error("the URDF cannot be parsed: " + errors + error.what());
  }
  if (!model || !model->getRoot()) {
    const std::string reason = collector.errors().empty() ? "it is no XML document" : collector.errors();
    throw std::runtime_error("the URDF cannot be parsed: " + reason);
  }
  return model;
}

/// urdfdom accepts these, but no joint position follows from them.
void checkJoint(const urdf::ModelInterface& model, const urdf::Joint& joint) {
  if (hasPosition(joint) && joint.axis.x == 0.0 && joint.axis.y == 0.0 && joint.axis.z == 0.0) {
    throw std::runtime_error("joint " + joint.name + ": its axis is 0 0 0");
  }
  if (joint.type == urdf::Joint::UNKNOWN) throw std::runtime_error("joint " + joint.name + ": unknown type");
  constexpr std::size_t kMostLeaders = 100;  // all positions are computed through them, one after another
  std::set<std::string> seen = {joint.name};
  for (const urdf::Joint* follower = &joint; follower->mimic;) {
    const std::string& leader = follower->mimic->joint_name;
    const auto found = model.joints_.find(leader);
    if (found == model.joints_.end()) {
      throw std::runtime_error("joint " + follower->name + " mimics " + leader + ", which does not exist");
    }
    if (!seen.insert(leader).second) throw std::runtime_error("joint " + joint.name + " mimics itself");
    if (seen.size() > kMostLeaders)
      throw std::runtime_error("joint " + joint.name + " mimics a joint that mimics another, and so on, more than " +
                               std::to_string(kMostLeaders) + " times");
    follower = found->second.get();
  }
}

/// urdfdom accepts links with several parent joints, and loops apart from the root, whose links it drops.
void checkTree(const urdf::ModelInterface& model) {
  std::map<std::string, std::string> joint_above;  // by child link
  for (const auto& [name, joint] : model.joints_) {
    const auto [above, is_new] = joint_above.emplace(joint->child_link_name, name);
    if (is_new) continue;
    throw std::runtime_error("link " + above->first + " is the child of two joints, " + above->second + " and " + name);
  }
  std::set<std::string> reached;
  std::vector<const urdf::Link*> open = {model.getRoot().get()};
  while (!open.empty()) {
    const urdf::Link* link = open.back();
    open.pop_back();
    reached.insert(link->name);
    for (const auto& child : link->child_links) open.push_back(child.get());
  }
  for (const auto& link : model.links_) {
    if (reached.count(link.first) > 0) continue;
    throw std::runtime_error("no chain of joints leads from the root link " + model.getRoot()->name + " to link " +
                             link.first + ": it is in a loop, or below one");
  }
}

/// Some URDFs have limits in the wrong order; without this every position would be beyond a limit.
void orderLimits(urdf::Joint& joint, std::vector<std::string>& warnings) {
  if (joint.type != urdf::Joint::REVOLUTE && joint.type != urdf::Joint::PRISMATIC) return;
  if (!joint.limits || !(joint.limits->lower > joint.limits->upper)) return;
  warnings.push_back("joint " + joint.name + ": its lower limit " + numberText(joint.limits->lower) +
                     " is above its upper one " + numberText(joint.limits->upper) + "; they are swapped");
  std::swap(joint.limits->lower, joint.limits->upper);
}

}  // namespace

std::shared_ptr<urdf::ModelInterface> parseUrdf(const std::string& xml, std::vector<std::string>& warnings) {
  const auto model = parse(xml, warnings);
  constexpr std::size_t kMaxLinks = 10'000;
  if (model->links_.size() > kMaxLinks) {
    throw std::runtime_error("the URDF has " + std::to_string(model->links_.size()) + " links, more than " +
                             std::to_string(kMaxLinks));
  }
  for (const auto& joint : model->joints_) checkJoint(*model, *joint.second);
  checkTree(*model);
  for (const auto& joint : model->joints_) orderLimits(*joint.second, warnings);
  return model;
}

std::string urdfErrors(const std::string& xml) {
  const std::lock_guard<std::mutex> lock(handler_mutex);
  MessageCollector collector;
  urdf::parseURDF(xml);
  return collector.errors();
}

}  // namespace sdf_ccd
