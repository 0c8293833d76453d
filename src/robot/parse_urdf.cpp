#include "parse_urdf.h"

#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include "common/number_text.h"
#include "common/shown_text.h"
#include "common/text_limits.h"
#include "joint_tree.h"
#include "misplaced_elements.h"
#include "readable_link.h"
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

/// Changes a robot so that urdfdom reads all that matters here.
void makeRobotReadable(tinyxml2::XMLElement& robot, std::vector<std::string>& warnings) {
  constexpr std::size_t kMaxLinks = 10'000;
  std::size_t links = 0;
  for (auto link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) ++links;
  if (links > kMaxLinks) {
    throw std::runtime_error("it has " + std::to_string(links) + " links, more than " + std::to_string(kMaxLinks));
  }
  if (!robot.Attribute("name")) robot.SetAttribute("name", "robot");
  robot.DeleteAttribute("version");  // the parser refuses those that it does not know
  while (tinyxml2::XMLElement* material = robot.FirstChildElement("material")) robot.DeleteChild(material);
  for (auto link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) makeReadable(*link);
  makeTree(robot, warnings);
}

/// Whether it has an element of xacro, definitions included.
bool hasMacros(const tinyxml2::XMLElement& element) {
  if (std::string(element.Name()).rfind("xacro:", 0) == 0) return true;
  for (auto child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    if (hasMacros(*child)) return true;
  return false;
}

/// What a document is that is no URDF, or is none yet; empty if nothing is known about it.
std::string otherKind(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (xml.size() > kMaxXmlBytes || document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) return {};
  const tinyxml2::XMLElement* root = document.RootElement();
  if (!root) return {};
  const std::string name = root->Name();
  if (name == "sdf" || name == "gazebo")
    return "it is a model of Gazebo (SDF, its root is <" + name + ">), not a URDF: give the URDF of the same robot";
  if (name != "robot") return "its root is <" + shownText(name) + ">, that of a URDF is <robot>";
  if (hasMacros(*root))
    return "it is a xacro file that has not been expanded: run `xacro FILE > robot.urdf`, and give robot.urdf";
  return {};
}

/// The document as written by tinyxml2, because urdfdom's XML reader reads beyond the end of some damaged documents.
std::string wellFormed(const std::string& xml, std::vector<std::string>& warnings) {
  requireXmlSize(xml);
  const std::string text = soundText(xml);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) throw std::runtime_error(xmlError(document));
  if (const std::string macros = unexpandedMacros(document, "URDF"); !macros.empty()) warnings.push_back(macros);
  if (tinyxml2::XMLElement* robot = document.FirstChildElement("robot")) {
    const std::vector<std::string> misplaced = misplacedElements(*robot);
    warnings.insert(warnings.end(), misplaced.begin(), misplaced.end());
    makeRobotReadable(*robot, warnings);
  }
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  return soundText(printer.CStr());  // again: references like &#27; are characters by now
}

std::shared_ptr<urdf::ModelInterface> parse(const std::string& xml, std::vector<std::string>& warnings) {
  const auto refuse = [&](const std::string& reason) {
    const std::string kind = otherKind(soundText(xml));
    throw std::runtime_error("the URDF cannot be parsed: " + kind + (kind.empty() ? "" : " (") + reason +
                             (kind.empty() ? "" : ")"));
  };
  std::string text;
  try {
    text = wellFormed(xml, warnings);
  } catch (const std::exception& error) {
    refuse(error.what());
  }
  const std::lock_guard<std::mutex> lock(handler_mutex);
  MessageCollector collector;
  std::shared_ptr<urdf::ModelInterface> model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    refuse((collector.errors().empty() ? "" : collector.errors() + "; ") + error.what());
  }
  if (!model || !model->getRoot()) refuse(collector.errors().empty() ? "it is no XML document" : collector.errors());
  return model;
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
  for (const auto& joint : model->joints_) orderLimits(*joint.second, warnings);
  return model;
}

std::string urdfErrors(const std::string& xml) {
  const std::lock_guard<std::mutex> lock(handler_mutex);
  MessageCollector collector;
  try {
    urdf::parseURDF(xml);
  } catch (const std::exception& error) {
    return error.what();
  }
  return collector.errors();
}

}  // namespace sdf_ccd
