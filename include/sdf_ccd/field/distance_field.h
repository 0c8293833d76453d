#pragma once

#include <cstddef>
#include <memory>
#include <variant>

#include "sdf_ccd/field/sparse_grid.h"
#include "sdf_ccd/geometry/primitive.h"

namespace sdf_ccd {

/// A field at one place. Guarantee: |true distance − value| ≤ error.
struct FieldSample {
  double value;       ///< [m], negative inside; interpolated in the band, the middle of what is known elsewhere
  double error;       ///< [m]
  Vector3d gradient;  ///< of `value`, pointing out, not normalised; zero where nothing is known of it
};

/// Signed distance to the surface of one solid, in its frame F: of a primitive (exact) or of a mesh (sampled).
///
/// A value type: copies share the samples, which never change.
/// Sampled fields hold samples of the true distance in a band around the surface and bounds of it everywhere else,
/// also outside their box; "no data" is never zero.
class DistanceField {
 public:
  explicit DistanceField(const Primitive& primitive);
  explicit DistanceField(std::shared_ptr<const SparseGrid> grid);

  /// Value, bound on its error and gradient at a finite point p_F [m], anywhere.
  FieldSample sample(const Vector3d& p_F) const;

  /// A number that the true distance is not below [m], anywhere; cheaper than sample().
  double lowerBound(const Vector3d& p_F) const;

  /// Where |φ| ≤ band() the error is at most errorBound() [m]. Infinity for primitives.
  double band() const;

  /// Bound on |interpolated − true distance| within the band [m]; 0 for primitives.
  double errorBound() const;

  /// Encloses the surface [m]; infinite for a half-space.
  const AlignedBox3d& surfaceBox() const { return surface_box_; }

  std::size_t bytes() const;

  /// The representation, for queries: one of the two is not null.
  const Primitive* primitive() const;
  const SparseGrid* grid() const;

 private:
  std::variant<Primitive, std::shared_ptr<const SparseGrid>> representation_;
  AlignedBox3d surface_box_;
};

}  // namespace sdf_ccd
