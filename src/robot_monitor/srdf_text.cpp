#include <cstdio>
#include <stdexcept>

#include <tinyxml2.h>

#include "common/number_text.h"
#include "common/text_limits.h"
#include "robot/srdf_pairs.h"
#include "robot_monitor/learn_pairs.h"

namespace sdf_ccd {
namespace {

/// "10000 random states (seed 1) and 61 recorded ones".
std::string statesText(const LearnedPairs& pairs) {
  std::string text;
  if (pairs.states > 0) {
    text = std::to_string(pairs.states) + " random states (seed " + std::to_string(pairs.seed) + ")";
  }
  if (pairs.recorded > 0) {
    text += (text.empty() ? "" : " and ") + std::to_string(pairs.recorded) + " recorded states";
  }
  return text;
}

std::string commentText(const LearnedPairs& pairs) {
  std::string text = " The following pairs were learned by `sdf_ccd learn-pairs` from " + statesText(pairs) +
                     ", with an error bound of " + numberText(1e3 * pairs.error_bound) +
                     " mm.\n       Adjacent: joined by one joint; not tested. Always: touched, or as neighbours came "
                     "within 1 mm, in all recorded and the first " +
                     std::to_string(pairs.always_states) +
                     " random ones.\n       Never: farther apart than the bound in all of these states. That is NO "
                     "PROOF: ";
  if (pairs.states > 0) {
    text += "with 95 %\n       confidence each touches in less than " + numberText(300.0 / double(pairs.states)) +
            " % of states that are drawn like these.";
  } else {
    text += "it holds for what was recorded.";
  }
  return text + " ";
}

/// XML comments must not contain two hyphens in a row.
std::string asComment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) text.replace(at, 2, "- ");
  return text;
}

}  // namespace

std::string srdfWith(const LearnedPairs& pairs, const RobotModel& robot, const std::string& given) {
  tinyxml2::XMLDocument document;
  if (given.empty()) {
    document.InsertEndChild(document.NewDeclaration());
    tinyxml2::XMLElement* root = document.NewElement("robot");
    root->SetAttribute("name", robot.urdf().getName().c_str());
    document.InsertEndChild(root);
  } else {
    parseSrdf(given);  // throws with the reason
    const std::string text = soundText(given);
    document.Parse(text.data(), text.size());
  }
  tinyxml2::XMLElement* root = document.RootElement();
  root->InsertEndChild(document.NewComment(asComment(commentText(pairs)).c_str()));
  for (const PairDecision& pair : pairs.disabled) {
    tinyxml2::XMLElement* element = document.NewElement("disable_collisions");
    element->SetAttribute("link1", pair.body_a.c_str());
    element->SetAttribute("link2", pair.body_b.c_str());
    element->SetAttribute("reason", srdfReason(pair.kind));
    root->InsertEndChild(element);
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace sdf_ccd
