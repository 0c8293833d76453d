#include "prepared_bodies.h"

#include <algorithm>
#include <stdexcept>

#include "mesh/triangle_tree.h"
#include "scene/body_shell.h"
#include "scene/body_surface.h"
#include "scene/body_triangles.h"
#include "scene/build_body.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kUnused = 256, kUnusedBytes = std::size_t{32} << 20;  // limits of the unused bodies that are kept

std::size_t bytesOf(const TriangleMesh& mesh) {
  return mesh.vertices.size() * sizeof(Vector3d) + mesh.triangles.size() * sizeof(Vector3i);
}

/// Of all that it has, also what it shares with others: reports count that for one of them.
std::size_t bytesOf(const Body& body) {
  std::size_t bytes = bytesOf(*body.shell, *body.tree);
  for (const BodyPart& part : body.parts) bytes += part.field.bytes();
  if (body.surface) bytes += bytesOf(body.surface->mesh) + body.surface->tree.bytes();
  if (body.triangles) bytes += body.triangles->bytes();
  if (body.doubtful) bytes += body.doubtful->bytes();
  return bytes;
}

/// Whether a body that was prepared with these needs also has all that `wanted` requires.
bool cover(const BodyNeeds& mine, const BodyNeeds& wanted) {
  const auto has = [&](auto need) { return mine.*need || !(wanted.*need); };
  return has(&BodyNeeds::field) && has(&BodyNeeds::shell) && has(&BodyNeeds::triangles) && has(&BodyNeeds::surface);
}

BodyNeeds unite(const BodyNeeds& a, const BodyNeeds& b) {
  return {a.field || b.field, a.shell || b.shell, a.triangles || b.triangles, a.surface || b.surface};
}

}  // namespace

PreparedBody* PreparedBodies::find(const std::string& key, const BodyNeeds& needs) {
  const auto found = bodies_.find(key);
  return found != bodies_.end() && cover(found->second.needs, needs) ? &found->second : nullptr;
}

const PreparedBody* PreparedBodies::find(const std::string& key) const {
  const auto found = bodies_.find(key);
  return found == bodies_.end() ? nullptr : &found->second;
}

const PreparedBody* PreparedBodies::find(const std::string& key, const BodyNeeds& needs) const {
  const PreparedBody* const found = find(key);
  return found && cover(found->needs, needs) ? found : nullptr;
}

PreparedBody& PreparedBodies::make(const std::string& key, const BodyDescription& description, const BodyNeeds& needs,
                                   const BodyOptions& options, MeshPool& pool) {
  const auto known = bodies_.find(key);
  const BodyNeeds all = known == bodies_.end() ? needs : unite(known->second.needs, needs);
  const BuiltBody built = buildBody(description, all, options, pool, {});
  if (!built.body.failure.empty()) throw std::invalid_argument(description.name + ": " + built.body.failure);
  return add(key, all, built.body, built.report);
}

PreparedBody& PreparedBodies::add(const std::string& key, const BodyNeeds& needs, const Body& body,
                                  const BodyReport& report) {
  PreparedBody& prepared = bodies_[key];
  prepared = {needs, std::make_shared<const Body>(body), report, prepared.used};
  return prepared;
}

PreparedBody& PreparedBodies::add(const std::string& key, const PreparedBody& body) {
  return bodies_[key] = body;
}

void PreparedBodies::merge(const PreparedBodies& others) {
  for (const auto& [key, body] : others.bodies_)
    if (!find(key, body.needs)) add(key, body);
}

void PreparedBodies::dropUnused(std::uint64_t version) {
  std::vector<std::pair<std::uint64_t, std::string>> unused;
  for (const auto& [key, prepared] : bodies_)
    if (prepared.used < version) unused.emplace_back(prepared.used, key);
  std::sort(unused.rbegin(), unused.rend());  // the most recent first
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < unused.size(); ++i) {
    bytes += bytesOf(*bodies_[unused[i].second].body);
    if (i >= kUnused || bytes > kUnusedBytes) bodies_.erase(unused[i].second);
  }
}

}  // namespace sdf_ccd
