#pragma once

#include <memory>

#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// The representation of a field, of which applications see nothing.
struct FieldAccess {
  /// A sampled field. @param openings  null where there are none. @param moved  see DistanceField::moved().
  /// @throws std::invalid_argument if there is no grid, or `moved` is not a distance.
  ///@{
  static DistanceField make(std::shared_ptr<const SparseGrid> grid, std::shared_ptr<const OpeningCaps> openings = {},
                            double moved = 0.0);
  static DistanceField make(std::shared_ptr<const AdaptiveGrid> grid, std::shared_ptr<const OpeningCaps> openings = {},
                            double moved = 0.0);
  ///@}

  /// Exactly one of these and DistanceField::primitive() is not null.
  ///@{
  static const SparseGrid* grid(const DistanceField& field);
  static const AdaptiveGrid* adaptive(const DistanceField& field);
  ///@}

  /// The caps: parts of the surface that are not on the mesh. Null if there are none.
  static const OpeningCaps* openings(const DistanceField& field) { return field.openings_.get(); }
};

}  // namespace sdf_ccd
