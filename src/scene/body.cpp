#include "sdf_ccd/body.h"

#include <stdexcept>

namespace sdf_ccd {

const DistanceField& Body::field() const& {
  if (parts.size() == 1 && parts[0].X_BG.matrix() == Isometry3d::Identity().matrix()) return parts[0].field;
  throw std::logic_error("body " + name + " has " + std::to_string(parts.size()) +
                         " fields, or one in a frame of its own: see Body::parts");
}

}  // namespace sdf_ccd
