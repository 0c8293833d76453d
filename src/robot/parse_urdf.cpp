#include "parse_urdf.h"

#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include "common/number_text.h"
#include "common/shown_text.h"
#include "common/text_limits.h"
#include "joint_tree.h"
#include "readable_link.h"
#include "unread_shapes.h"
#include "xml_text.h"

namespace sdf_ccd {
namespace {

using tinyxml2::XMLElement;

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
void makeRobotReadable(XMLElement& robot, std::vector<std::string>& warnings) {
  constexpr std::size_t kMaxLinks = 10'000;
  std::size_t links = 0;
  for (auto link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) ++links;
  if (links > kMaxLinks) {
    throw std::runtime_error("it has " + std::to_string(links) + " links, more than " + std::to_string(kMaxLinks));
  }
  if (!robot.Attribute("name")) robot.SetAttribute("name", "robot");
  robot.DeleteAttribute("version");  // the parser refuses those that it does not know
  while (XMLElement* material = robot.FirstChildElement("material")) robot.DeleteChild(material);
  for (auto link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) makeReadable(*link);
  makeTree(robot, warnings);
}

std::string lineOf(const XMLElement& element) {
  return "line " + std::to_string(element.GetLineNum()) + " of the URDF: ";
}

/// Links with a shape that urdfdom passes over, or with the name of another one.
std::map<std::string, std::string> passedOver(const XMLElement& robot) {
  std::map<std::string, std::string> reasons;
  std::set<std::string> names;
  for (auto link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) {
    const std::string name = soundText(linkName(*link)), shape = unreadShape(*link);
    if (!names.insert(name).second) {
      reasons[name] = lineOf(*link) + "a second link has this name";
    } else if (!shape.empty()) {
      reasons[name] = shape;
    }
  }
  return reasons;
}

/// Adds the links of which urdfdom has not read all collision elements.
void addDropped(const XMLElement& robot, ParsedUrdf& parsed) {
  for (auto link = robot.FirstChildElement("link"); link; link = link->NextSiblingElement("link")) {
    std::size_t written = 0;
    for (auto each = link->FirstChildElement("collision"); each; each = each->NextSiblingElement("collision"))
      ++written;
    const std::string name = soundText(linkName(*link));
    const std::size_t read = parsed.model->links_.at(name)->collision_array.size();
    if (read == written || parsed.unread.count(name) > 0) continue;
    tinyxml2::XMLPrinter printer(nullptr, true);
    link->Accept(&printer);
    parsed.unread[name] = lineOf(*link) + std::to_string(written - read) + " of " + std::to_string(written) +
                          " collision elements cannot be read: " +
                          urdfErrors(std::string("<robot name=\"link\">") + printer.CStr() + "</robot>");
  }
}

std::shared_ptr<urdf::ModelInterface> modelOf(const std::string& text) {
  const std::lock_guard<std::mutex> lock(handler_mutex);
  MessageCollector collector;
  std::shared_ptr<urdf::ModelInterface> model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    throw std::runtime_error((collector.errors().empty() ? "" : collector.errors() + "; ") + error.what());
  }
  if (!model || !model->getRoot()) throw std::runtime_error(collector.errors());
  return model;
}

/// @param macro  set to unexpandedMacro(), also if it throws.
ParsedUrdf read(const std::string& xml, std::string& macro) {
  tinyxml2::XMLDocument document;
  XMLElement& robot = parseRobotXml(xml, document);
  ParsedUrdf parsed;
  macro = unexpandedMacro(robot, "URDF");
  if (!macro.empty()) parsed.warnings.push_back(macro);
  for (std::string& line : shapesOutsideLinks(robot)) parsed.warnings.push_back(std::move(line));
  parsed.unread = passedOver(robot);
  makeRobotReadable(robot, parsed.warnings);
  // As written by tinyxml2, because urdfdom's XML reader reads beyond the end of some damaged documents; checked again,
  // as references like &#27; are characters by now.
  tinyxml2::XMLPrinter printer(nullptr, true);
  robot.Accept(&printer);
  parsed.model = modelOf(soundText(printer.CStr()));
  addDropped(robot, parsed);
  return parsed;
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

ParsedUrdf parseUrdf(const std::string& xml) {
  std::string macro;
  try {
    ParsedUrdf parsed = read(xml, macro);
    for (const auto& joint : parsed.model->joints_) orderLimits(*joint.second, parsed.warnings);
    return parsed;
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("the URDF cannot be parsed: ") + error.what() +
                             (macro.empty() ? "" : "; " + macro));
  }
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
