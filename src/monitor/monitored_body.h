#pragma once

#include <memory>
#include <vector>

#include "contact/penalty.h"
#include "contact/point_groups.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// A body, with what its contacts need beside it. The same in all versions of a scene that have the body.
struct MonitoredBody {
  explicit MonitoredBody(BodyList::Shared of_body);

  BodyList::Shared body;
  std::vector<std::vector<SiblingField>> siblings;  ///< per part
  std::vector<NodeSum> sums;                        ///< of its shell
};

}  // namespace sdf_ccd
