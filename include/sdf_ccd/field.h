#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "sdf_ccd/mesh.h"
#include "sdf_ccd/primitive.h"

namespace sdf_ccd {

class AdaptiveGrid;
class OpeningCaps;
class SparseGrid;

/// A field at one point. Guarantee: |true distance − value| ≤ error.
struct FieldSample {
  double value;       ///< [m], negative inside; interpolated in the band, the middle of the bounds elsewhere
  double error;       ///< [m]
  Vector3d gradient;  ///< of `value`, pointing out, not normalised; zero where it is unknown
};

/// The same without the error.
struct FieldValue {
  double value;
  Vector3d gradient;
};

/// Bounds of the true distance at one point [m].
struct DistanceBounds {
  double low;
  double high;
};

/// Signed distance to the surface of one solid, in its frame F: of a primitive (exact) or of a mesh (sampled in cells
/// of one size, or of sizes that follow the shape).
///
/// A value type: copies share the samples, which never change.
/// For a mesh with openings, the surface includes caps that close it, which the field stores: near the caps, and
/// inside, it describes a solid that the mesh does not bound on all sides (see hasOpenings()).
/// Sampled fields hold samples of the true distance in a band around the surface and bounds of it everywhere else,
/// also outside their box; "no data" is never zero.
class DistanceField {
 public:
  /// The exact distance to a primitive.
  /// @throws std::invalid_argument if it is not valid.
  explicit DistanceField(const Primitive& primitive);

  /// Value, bound on its error and gradient at a finite point p_F [m], anywhere. The bound is local: that of the
  /// point's leaf, or of the samples around the point (see src/field/uniform/sample_bracket.h).
  FieldSample sample(const Vector3d& p_F) const;

  /// The same value and gradient without the error; cheaper.
  FieldValue interpolate(const Vector3d& p_F) const;

  /// Bounds of the true distance [m], anywhere; cheaper and wider than sample(). Outside the grid `high` is
  /// infinite.
  DistanceBounds bounds(const Vector3d& p_F) const;
  /// The lower one of bounds() [m].
  double lowerBound(const Vector3d& p_F) const { return bounds(p_F).low; }

  /// Where |φ| ≤ band() the error is at most errorBound() [m]. Infinity for primitives.
  double band() const;

  /// Bound on |interpolated − true distance| within the band [m]; 0 for primitives.
  double errorBound() const;

  /// Upper bound of the distance between the surface that was sampled and that of the mesh [m]: nearly equal vertices
  /// were joined, cracks closed, or vertices moved to the lattice of their voxels. All error bounds include it.
  double moved() const { return moved_; }

  /// Whether parts of the surface are not on the mesh: caps of its openings. If not, the whole surface is on the mesh,
  /// within moved(), and the sign is certain. (Caps of cracks, no point of which is farther from the mesh than a
  /// quarter of errorBound(), are in moved() instead.)
  bool hasOpenings() const { return openings_ != nullptr; }

  /// Lower bound of the distance to the parts of the surface that are not on the mesh [m]; infinity if there are none.
  double openingDistance(const Vector3d& p_F) const;

  /// The distance from the mesh alone; without openings as sample(). Guarantee: |s − value| ≤ error for the
  /// distance s from the mesh; where p_F counts as inside, for either sign of s. The value is that of sample(), so the
  /// error is large inside, and where a cap may be the nearest surface.
  FieldSample meshSample(const Vector3d& p_F) const;

  /// Encloses the surface [m]; infinite for a half-space.
  const AlignedBox3d& surfaceBox() const { return surface_box_; }

  /// Memory that copies share: samples and caps.
  std::size_t bytes() const;

  /// Cells that hold samples; 0 for primitives.
  std::size_t cells() const;

  /// Box of the grid [m], outside of which only bounds are known; for a primitive, the box of its surface.
  AlignedBox3d box() const;

  /// The primitive whose exact distance it is; null for a sampled field.
  const Primitive* primitive() const;

 private:
  friend struct FieldAccess;
  DistanceField(std::variant<Primitive, std::shared_ptr<const SparseGrid>, std::shared_ptr<const AdaptiveGrid>> grid,
                const AlignedBox3d& surface_box, std::shared_ptr<const OpeningCaps> openings, double moved);

  std::variant<Primitive, std::shared_ptr<const SparseGrid>, std::shared_ptr<const AdaptiveGrid>> representation_;
  AlignedBox3d surface_box_;
  std::shared_ptr<const OpeningCaps> openings_;
  double moved_ = 0.0;
};

/// Writes a sampled field. The file appears under its name complete or not at all, and holds a checksum.
/// @param key  what the field was made from, up to 63 characters; loadField() can compare it.
/// @throws std::invalid_argument for a primitive's field, which is exact and needs no file; std::runtime_error naming
/// the path and the reason.
void saveField(const DistanceField& field, const std::string& path, const std::string& key = {});

/// Reads a field file.
/// @param key  if not empty, the file must have been saved with the same.
/// @throws std::runtime_error naming the path and what is wrong with the file.
DistanceField loadField(const std::string& path, const std::string& key = {});

/// True if the file begins like one of saveField().
bool isFieldFile(const std::string& path);

/// How fine a field is. At most one of the first three is set; if none is, max_error is kDefaultMaxError.
struct FieldOptions {
  static constexpr double kDefaultMaxError = 5.5e-4;  ///< the share of fields in Accuracy::max_error by default [m]

  std::optional<int> cells;         ///< cells along the longest side of the surface's box
  std::optional<double> cell_size;  ///< [m]
  /// |interpolated − true distance| in the band [m]; cells of several sizes. If the smallest ones do not suffice, the
  /// field has a larger DistanceField::errorBound().
  std::optional<double> max_error;
  double band = 0.0;  ///< accurate where |φ| ≤ band [m]; at least two cells, or twice max_error, are used
  /// Larger fields are refused, with the cell size or the error that would fit. Building takes up to about twice as
  /// much, and a few megabytes per thread.
  std::size_t max_bytes = std::size_t{4} << 30;
};

/// How densely a surface is sampled.
struct ShellOptions {
  double spacing = 0.01;  ///< no location of the surface farther than this from a point, but for its rounding [m]
  /// If less than the spacing, edges are sampled separately: if two surfaces sampled like this touch, a point of one is
  /// no farther than this from the other, but for its rounding (see contact_gap.h) [m]. 0: edges are not sampled
  /// separately.
  double edge_gap = 0.0;
  bool has_siblings = false;  ///< the surface is one of several of a body, whose edges may be sampled separately
  /// Mesh vertices nearer than this to a kept vertex are left out [m]; 0 keeps all. For a mesh whose parts overlap, it
  /// is at least a tenth of the spacing (or edge gap).
  double vertex_spacing = 0.0;
  std::uint64_t seed = 1;               ///< equal seeds give equal shells
  std::size_t max_points = 20'000'000;  ///< more are refused with std::length_error
};

/// Throws std::invalid_argument, with the value, for options that no field can have.
void validate(const FieldOptions& options);

/// Called from one thread at a time with the share done, from 0 to 1.
using Progress = std::function<void(double)>;

/// Samples the signed distance to the boundary of a mesh's solid (paper §3, Table 1): exact closest points on the
/// boundary, signs from the winding number. Where parts overlap, the depth is that in their union (see Solid).
///
/// Uses all threads of the caller's TBB arena; the result does not depend on their number.
/// A mesh that is not closed is closed by caps (see findOpenings()): the field is that of the closed solid, and records
/// where its surface is a cap (see DistanceField::hasOpenings()).
/// @param mesh  frame F, oriented (see orientOutward()).
/// @throws std::invalid_argument for a mesh or options that are not valid.
/// @throws std::length_error if the field would exceed options.max_bytes.
DistanceField buildField(const TriangleMesh& mesh, const FieldOptions& options, const Progress& progress = {});

}  // namespace sdf_ccd
