#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/geometry_keys.h"
#include "scene/mesh_pool.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// A prepared body, without name and pose.
struct PreparedBody {
  BodyNeeds needs;
  std::shared_ptr<const Body> body;
  BodyReport report;
  std::uint64_t used = 0;  ///< version of the world that last used it
};

/// Prepared bodies by the key of their geometry.
class PreparedBodies {
 public:
  /// Null if there is none that has all of `needs`.
  PreparedBody* find(const std::string& key, const BodyNeeds& needs);
  const PreparedBody* find(const std::string& key, const BodyNeeds& needs) const;

  /// Null if there is none, whatever it has.
  const PreparedBody* find(const std::string& key) const;

  /// Prepares a body with `needs` and those of an existing body of the same geometry, which it replaces.
  /// @throws std::invalid_argument with the body's name if it cannot be made.
  PreparedBody& make(const std::string& key, const BodyDescription& description, const BodyNeeds& needs,
                     const BodyOptions& options, MeshPool& pool);

  /// Adds a body that is prepared already.
  PreparedBody& add(const std::string& key, const BodyNeeds& needs, const Body& body, const BodyReport& report);
  PreparedBody& add(const std::string& key, const PreparedBody& body);

  /// Adds those of the others that have more than the present ones.
  void merge(const PreparedBodies& others);

  /// Removes bodies last used before that version, except the most recent ones.
  void dropUnused(std::uint64_t version);

 private:
  std::unordered_map<std::string, PreparedBody> bodies_;
};

}  // namespace sdf_ccd
