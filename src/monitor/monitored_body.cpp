#include "monitored_body.h"

#include <utility>

namespace sdf_ccd {

MonitoredBody::MonitoredBody(BodyList::Shared of_body)
    : body(std::move(of_body)), sums(nodeSums(*body->shell, *body->tree)) {
  const std::vector<BodyPart>& parts = body->parts;
  siblings.resize(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (k != i) siblings[i].push_back({&parts[k].field, parts[k].X_BG.inverse() * parts[i].X_BG, k < i});
}

}  // namespace sdf_ccd
