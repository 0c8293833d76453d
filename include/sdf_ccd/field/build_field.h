#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/mesh/triangle_mesh.h"

namespace sdf_ccd {

/// How fine a field is. At most one of the first three is set; if none is, max_error is kDefaultMaxError.
struct FieldOptions {
  static constexpr double kDefaultMaxError = 5.5e-4;  ///< the share of fields in Accuracy::max_error by default [m]

  std::optional<int> cells;         ///< cells along the longest side of the surface's box
  std::optional<double> cell_size;  ///< [m]
  /// |interpolated − true distance| in the band [m]; cells of several sizes. If the smallest ones do not suffice, the
  /// field has a larger DistanceField::errorBound().
  std::optional<double> max_error;
  double band = 0.0;  ///< accurate where |φ| ≤ band [m]; at least two cells, or twice max_error, are taken
  /// Larger fields are refused, with the cell size or the error that would fit. Building takes up to about twice as
  /// much, and a few megabytes per thread.
  std::size_t max_bytes = std::size_t{4} << 30;
};

/// Throws std::invalid_argument, with the value, for options that no field can have.
void validate(const FieldOptions& options);

/// The options with a resolution. @throws as validate().
FieldOptions withResolution(FieldOptions options);

/// Called from one thread at a time with the share done, from 0 to 1.
using Progress = std::function<void(double)>;

class ClosedSolid;
class Solid;

/// Samples the signed distance to the boundary of a mesh's solid (paper §3, Table 1): exact closest points on the
/// boundary, signs from the winding number. Where parts overlap, the depth is that in their union (see Solid).
///
/// Uses all threads of the caller's TBB arena; the result does not depend on their number.
/// A mesh that is not closed is closed by caps (see findOpenings()): the field is that of the closed solid, and records
/// where its surface is a cap (see DistanceField::openings()).
/// @param mesh  frame F, oriented (see orientOutward()).
/// @throws std::invalid_argument for a mesh or options that are not valid.
/// @throws std::length_error if the field would exceed options.max_bytes.
DistanceField buildField(const TriangleMesh& mesh, const FieldOptions& options, const Progress& progress = {});

/// The same for an existing solid.
DistanceField buildField(const Solid& solid, const FieldOptions& options, const Progress& progress = {});
/// The same for a solid whose openings are closed, with its caps.
DistanceField buildField(const ClosedSolid& closed, const FieldOptions& options, const Progress& progress = {});

}  // namespace sdf_ccd
