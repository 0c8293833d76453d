#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <urdf_model/model.h>

namespace sdf_ccd {

/// A URDF as urdfdom reads it, and what it does not.
struct ParsedUrdf {
  std::shared_ptr<urdf::ModelInterface> model;
  /// Links that have fewer collision shapes in the model than in the text, or have them elsewhere, and why: urdfdom
  /// stops reading a link at the first collision element that it cannot parse, and ignores what it does not expect. Of
  /// two links with one name only the first is read.
  std::map<std::string, std::string> unread;
  std::vector<std::string> warnings;  ///< shapes outside links, macros, limits in the wrong order, makeTree()
};

/// urdfdom's parser, with its messages in the exception instead of on the console.
/// @throws std::runtime_error if the text is no URDF, or has more than 10,000 links.
ParsedUrdf parseUrdf(const std::string& xml);

/// All messages of urdfdom's parser about a text, also if it returns a model.
std::string urdfErrors(const std::string& xml);

}  // namespace sdf_ccd
