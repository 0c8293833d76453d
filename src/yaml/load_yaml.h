#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

namespace sdf_ccd {

constexpr int kMaxYamlDepth = 64;

/// Throws where a document is nested too deeply; else does nothing.
class YamlDepthLimit : public YAML::EventHandler {
 public:
  using Style = YAML::EmitterStyle::value;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, Style) override { enter(mark); }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, Style) override { enter(mark); }
  void OnMapEnd() override { --depth_; }

 private:
  void enter(const YAML::Mark& mark) {
    if (++depth_ <= kMaxYamlDepth) return;
    throw std::runtime_error("line " + std::to_string(mark.line + 1) + ": nested more than " +
                             std::to_string(kMaxYamlDepth) + " levels deep");
  }

  int depth_ = 0;
};

/// Parses a YAML document. The parser recurses for each nested level, before version 0.7 without a limit, so the depth
/// is checked first, by the parser's own events.
/// @throws std::runtime_error if it is no YAML or nested deeper than kMaxYamlDepth.
inline YAML::Node loadYaml(const std::string& yaml) {
  std::istringstream stream(yaml);
  YamlDepthLimit limit;
  YAML::Parser(stream).HandleNextDocument(limit);
  return YAML::Load(yaml);
}

}  // namespace sdf_ccd
