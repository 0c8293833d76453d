#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/query/verdict.h"
#include "sdf_ccd/scene/scene_description.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

struct BodySurface;
struct BodyTriangles;
class TriangleTree;

/// One collision element with its field.
struct BodyPart {
  Isometry3d X_BG;
  DistanceField field;
};

/// Radius of the ball that represents a half-space, about the origin of its body [m]. The ball also contains everything
/// else that the body has.
constexpr double kHalfSpaceRadius = 10.0;

/// A body's half-space, in the body's frame.
struct BodyHalfSpace {
  HalfSpace half_space;
  double deviation;  ///< upper bound of its displacement by rounding [m]
};

/// A body that is ready to be checked.
struct Body : BodyPlace {
  std::string warning;          ///< about the inside of its meshes (see warningOf()); empty if there is none
  std::vector<BodyPart> parts;  ///< empty if no pair needs its field
  /// Points of the surface, frame B, and their tree; none if no pair needs them, or deep inside a sibling part.
  ///@{
  std::shared_ptr<const PointShell> shell = std::make_shared<const PointShell>();
  std::shared_ptr<const SphereTree> tree = std::make_shared<const SphereTree>();
  ///@}
  std::shared_ptr<const BodySurface> surface;      ///< for voxels of a live map that are those of the body; else null
  std::shared_ptr<const BodyTriangles> triangles;  ///< of its bounded elements, which decide verdicts
  std::vector<BodyHalfSpace> half_spaces;          ///< its unbounded elements, which do so, too
  /// All bounded geometry of a body with a mesh whose sign is not trusted (MeshQuality::sign_trusted), with caps in
  /// openings and boxes around primitives, frame B. Only points with a free line of sight to the outside are certainly
  /// outside. Null for other bodies, whose fields give the sign.
  std::shared_ptr<const TriangleTree> doubtful;
  bool inside_is_doubtful = false;      ///< for such a body: its fields may also treat cavities as solid
  BoundingBall ball;                    ///< contains the body's surface, frame B; see kHalfSpaceRadius
  std::shared_ptr<const void> content;  ///< keeps alive data shared with other bodies

  /// The field of a body with one element, whose frame is the body frame.
  /// @throws std::logic_error if it is not.
  const DistanceField& field() const&;
  const DistanceField& field() const&& = delete;  ///< the body would be destroyed before the field is used
};

/// What was built for one body; a row of the plan's table.
struct BodyReport {
  std::string name;
  std::string geometry;         ///< "mesh (300 triangles, closed)", "box", …
  std::string field;            ///< "cached", "built 1.2 s", "exact", "shared", "left out"
  std::size_t field_bytes = 0;  ///< data shared by several bodies, such as a mesh, is counted for the first one
  std::size_t cells = 0;        ///< stored cells
  double field_error = 0.0;     ///< [m]
  std::size_t shell_points = 0;
  std::size_t shell_bytes = 0;  ///< with the triangles that decide verdicts
  double gap = 0.0;             ///< between its shell's points, for a pair of equal shells [m]
  std::size_t pairs = 0;
  ErrorSources bound;  ///< of verdicts, largest over its pairs; chord: as the options allow
  std::string solid;   ///< parts of its meshes that were left out as inside their solids; empty if none, or cached
  std::vector<std::string> files;    ///< names in the cache of its fields and shells, except those of a body before it
  bool is_cache_incomplete = false;  ///< a field or shell was made for the cache but is not in it; a warning says why
  std::vector<std::string> warnings;
};

/// Bodies by index. Lists share bodies: a copy of a list copies no body, and two lists hold the same body if shared()
/// returns the same pointer.
class BodyList {
 public:
  /// A body as lists share it.
  using Shared = std::shared_ptr<const Body>;

  /// A forward iterator over bodies, not over pointers to them.
  class const_iterator {
   public:
    /// As of any forward iterator.
    ///@{
    using iterator_category = std::forward_iterator_tag;
    using value_type = Body;
    using difference_type = std::ptrdiff_t;
    using pointer = const Body*;
    using reference = const Body&;

    const_iterator() = default;
    explicit const_iterator(std::vector<Shared>::const_iterator at) : at_(at) {}
    const Body& operator*() const { return **at_; }
    const Body* operator->() const { return at_->get(); }
    const_iterator& operator++() { return ++at_, *this; }
    const_iterator operator++(int) { return const_iterator(at_++); }
    bool operator==(const const_iterator& other) const { return at_ == other.at_; }
    bool operator!=(const const_iterator& other) const { return at_ != other.at_; }
    ///@}

   private:
    std::vector<Shared>::const_iterator at_;
  };

  BodyList() = default;
  /// Of these bodies, which no other list shares yet.
  explicit BodyList(std::vector<Body> bodies) {
    for (Body& body : bodies) push_back(std::move(body));
  }

  /// As of a std::vector<const Body>.
  ///@{
  std::size_t size() const { return bodies_.size(); }
  bool empty() const { return bodies_.empty(); }
  const Body& operator[](std::size_t i) const { return *bodies_[i]; }
  const Body& front() const { return *bodies_.front(); }
  const Body& back() const { return *bodies_.back(); }
  const_iterator begin() const { return const_iterator(bodies_.begin()); }
  const_iterator end() const { return const_iterator(bodies_.end()); }
  ///@}

  /// The body itself, to be put into another list.
  const Shared& shared(std::size_t i) const { return bodies_[i]; }

  /// Adds a body: a new one, or one that other lists hold, too.
  ///@{
  void push_back(Body body) { bodies_.push_back(std::make_shared<const Body>(std::move(body))); }
  void push_back(Shared body) { bodies_.push_back(std::move(body)); }
  ///@}

 private:
  std::vector<Shared> bodies_;
};

}  // namespace sdf_ccd
