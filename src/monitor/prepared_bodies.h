#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "body/body_builder.h"
#include "body/geometry_keys.h"
#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// What of a body is needed by its pairs.
struct PreparedNeeds {
  BodyNeeds of_body;
  bool triangles = false;
  bool surface = false;

  /// Whether a body that was made with these has all that the other ones ask for.
  bool cover(const PreparedNeeds& other) const;
  PreparedNeeds operator|(const PreparedNeeds& other) const;
};

/// A body that was made, without a name and a place.
struct PreparedBody {
  PreparedNeeds needs;
  std::shared_ptr<const Body> body;
  BodyReport report;
  std::uint64_t used = 0;  ///< in which version last
};

/// Bodies by their geometry's key. Of those out of use the last few are kept.
class PreparedBodies {
 public:
  /// Null if there is none with all that is needed.
  PreparedBody* find(const std::string& key, const PreparedNeeds& needs);

  /// Makes one, with what an earlier one of the same geometry was made with, too.
  /// @throws std::invalid_argument with the body's name if it cannot be made.
  PreparedBody& make(const std::string& key, const BodyDescription& description, const PreparedNeeds& needs,
                     const BodyOptions& options, MeshPool& pool);

  /// One that is there already.
  PreparedBody& add(const std::string& key, const PreparedNeeds& needs, const Body& body, const BodyReport& report);

  /// Drops what no version since that one has used, but for the last few.
  void dropUnused(std::uint64_t version);

 private:
  std::unordered_map<std::string, PreparedBody> bodies_;
};

}  // namespace sdf_ccd
