#pragma once

#include <string>

#include "common/settings/setting.h"

namespace sdf_ccd {

/// The settings of a YAML document: what `rosparam load` would set, without a parameter server.
///
/// Plain scalars have the types that rosparam gives them (YAML 1.1: `yes` is a flag, `010` is 8, `1.0e8` a text, which
/// SettingsReader reads as a number); "a/b: 1" is b in the group a. rosparam's `deg(…)` and `rad(…)`, and numbers with
/// `_` or `:`, stay texts, so that reading them as numbers fails with their name.
/// @return a group; an empty one for an empty document.
/// @throws std::runtime_error with the line if it is no YAML, a value is empty, a name occurs twice, it is nested
/// too deeply, or has more than 100,000 values: a few lines of aliases can expand to 10⁹.
Setting parseYaml(const std::string& text);

/// The same from a file. @throws std::runtime_error with file and line, also if it cannot be read.
Setting loadYaml(const std::string& file);

}  // namespace sdf_ccd
