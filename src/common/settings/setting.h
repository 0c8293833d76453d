#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace sdf_ccd {

/// A value of a settings file or of ROS's parameter server.
struct Setting {
  using Group = std::map<std::string, Setting>;
  using List = std::vector<Setting>;

  std::variant<Group, List, bool, int, double, std::string> value;
  int line = 0;  ///< of the file; 0 if there is none

  bool isGroup() const { return std::holds_alternative<Group>(value); }
  bool isText() const { return std::holds_alternative<std::string>(value); }
};

}  // namespace sdf_ccd
