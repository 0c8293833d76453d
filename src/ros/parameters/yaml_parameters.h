#pragma once

#include <string>

#include <XmlRpcValue.h>

namespace sdf_ccd {

/// The parameters that `rosparam load FILE` would set, for parseParameters(), without a parameter server.
///
/// Plain scalars have the types that rosparam gives them (YAML 1.1: `yes` is a flag, `010` is 8, `1.0e8` a text, which
/// ParameterReader reads as a number); "a/b: 1" is b in the group a. rosparam's `deg(…)` and `rad(…)`, and numbers
/// with `_` or `:`, stay texts, so that reading them as numbers fails with their name.
/// @return a struct; nothing for an empty file.
/// @throws std::runtime_error with file, and line where known, if it cannot be read, is no YAML or a value is empty.
XmlRpc::XmlRpcValue loadYamlParameters(const std::string& file);

/// The same from the file's content. @param file  its name, for errors.
XmlRpc::XmlRpcValue parseYamlParameters(const std::string& text, const std::string& file);

}  // namespace sdf_ccd
