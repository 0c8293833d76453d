#include "sdf_ccd/body.h"

#include <memory>
#include <stdexcept>

#include "scene/build_body.h"

namespace sdf_ccd {
namespace {

BodyDescription describe(const std::string& name, GeometryDescription geometry) {
  BodyDescription description;
  description.name = description.frame = name;
  description.geometry.push_back(std::move(geometry));
  return description;
}

}  // namespace

Body prepareBody(const std::string& name, const Primitive& primitive, const Accuracy& accuracy) {
  return prepareBody(describe(name, {primitive, Isometry3d::Identity(), name}), accuracy);
}

Body prepareBody(const std::string& name, const TriangleMesh& mesh, const Accuracy& accuracy) {
  return prepareBody(describe(name, {std::make_shared<const TriangleMesh>(mesh), Isometry3d::Identity(), name}),
                     accuracy);
}

Body prepareBody(const BodyDescription& description, const Accuracy& accuracy) {
  BodyOptions options = optionsFor(accuracy);
  options.divides_max_error = false;  // too large means an error, not a coarser body
  MeshPool pool(options);
  BodyNeeds needs;
  needs.shell = whyNoShell(description).empty();
  needs.triangles = true;
  BuiltBody built = buildBody(description, needs, options, pool, {});
  Body& body = built.body;
  if (!body.failure.empty()) throw std::invalid_argument(description.name + ": " + body.failure);
  for (const std::string& warning : built.report.warnings)
    if (body.warning.find(warning) == std::string::npos) body.warning += (body.warning.empty() ? "" : "; ") + warning;
  return std::move(body);
}

}  // namespace sdf_ccd
