#include "prepared_bodies.h"

#include <algorithm>
#include <stdexcept>

#include "body/body_triangles.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kUnused = 256, kUnusedBytes = std::size_t{64} << 20;  // limits of the unused bodies that are kept

}  // namespace

bool PreparedNeeds::cover(const PreparedNeeds& other) const {
  const auto has = [](bool mine, bool wanted) { return mine || !wanted; };
  return has(of_body.field, other.of_body.field) && has(of_body.shell, other.of_body.shell) &&
         (!other.of_body.shell || !of_body.edges_only || other.of_body.edges_only) &&
         (!other.of_body.shell || has(of_body.decides, other.of_body.decides)) &&
         has(of_body.witnesses, other.of_body.witnesses) && has(triangles, other.triangles) &&
         has(surface, other.surface);
}

PreparedNeeds PreparedNeeds::operator|(const PreparedNeeds& other) const {
  PreparedNeeds all;
  all.of_body.field = of_body.field || other.of_body.field;
  all.of_body.shell = of_body.shell || other.of_body.shell;
  all.of_body.witnesses = of_body.witnesses || other.of_body.witnesses;
  // Edges suffice only if everyone who needs a shell needs only its edges.
  all.of_body.edges_only =
      all.of_body.shell && (!of_body.shell || of_body.edges_only) && (!other.of_body.shell || other.of_body.edges_only);
  all.of_body.decides = (of_body.shell && of_body.decides) || (other.of_body.shell && other.of_body.decides);
  all.triangles = triangles || other.triangles;
  all.surface = surface || other.surface;
  return all;
}

PreparedBody* PreparedBodies::find(const std::string& key, const PreparedNeeds& needs) {
  const auto found = bodies_.find(key);
  return found != bodies_.end() && found->second.needs.cover(needs) ? &found->second : nullptr;
}

PreparedBody& PreparedBodies::make(const std::string& key, const BodyDescription& description,
                                   const PreparedNeeds& needs, const BodyOptions& options, MeshPool& pool) {
  const auto known = bodies_.find(key);
  const PreparedNeeds all = known == bodies_.end() ? needs : known->second.needs | needs;
  BuiltBody built = buildBody(description, all.of_body, options, pool, {});
  if (!built.body.failure.empty()) throw std::invalid_argument(description.name + ": " + built.body.failure);
  if (all.triangles) built.body.triangles = trianglesOf(description, pool);
  if (all.surface) built.body.surface = surfaceOf(description, pool);
  return add(key, all, built.body, built.report);
}

PreparedBody& PreparedBodies::add(const std::string& key, const PreparedNeeds& needs, const Body& body,
                                  const BodyReport& report) {
  PreparedBody& prepared = bodies_[key];
  prepared = {needs, std::make_shared<const Body>(body), report, prepared.used};
  return prepared;
}

void PreparedBodies::dropUnused(std::uint64_t version) {
  std::vector<std::pair<std::uint64_t, std::string>> unused;
  for (const auto& [key, prepared] : bodies_)
    if (prepared.used < version) unused.emplace_back(prepared.used, key);
  std::sort(unused.rbegin(), unused.rend());  // the most recent first
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < unused.size(); ++i) {
    const BodyReport& report = bodies_[unused[i].second].report;
    bytes += report.field_bytes + report.shell_bytes;
    if (i >= kUnused || bytes > kUnusedBytes) bodies_.erase(unused[i].second);
  }
}

}  // namespace sdf_ccd
