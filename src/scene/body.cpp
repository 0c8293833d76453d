#include "sdf_ccd/body.h"

#include <memory>
#include <stdexcept>

#include "shell/point_shell.h"

namespace sdf_ccd {

Body::Body() : shell(std::make_shared<const PointShell>()), tree(std::make_shared<const SphereTree>()) {}

const DistanceField& Body::field() const& {
  if (parts.size() == 1 && parts[0].X_BG.matrix() == Isometry3d::Identity().matrix()) return parts[0].field;
  throw std::logic_error("body " + name + " has " + std::to_string(parts.size()) +
                         " fields, or one in a frame of its own: see Body::parts");
}

}  // namespace sdf_ccd
