#pragma once

#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/primitive.h"
#include "sdf_ccd/result.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// One collision element: a primitive, or a mesh as loaded and scaled.
struct GeometryDescription {
  std::variant<Primitive, std::shared_ptr<const TriangleMesh>> shape;
  Isometry3d X_BG = Isometry3d::Identity();  ///< its frame G in the body's frame B
  std::string source;                        ///< for display: "box" or the mesh's URI
  bool watertight_voxels = false;            ///< boundary of whole voxels: has no shell
  std::optional<double> cell_size = {};      ///< of a mesh's field [m]; none: that of BodyOptions::field
  std::optional<Vector3d> scale = {};        ///< of the mesh in the file `source`; none if that file has another name
  /// Of the mesh, made elsewhere (a map's tile), as accurate as the options require; none: it is built.
  std::optional<DistanceField> field = {};
};

/// Whether the element is a half-space, which is unbounded.
inline bool isHalfSpace(const GeometryDescription& geometry) {
  const auto* primitive = std::get_if<Primitive>(&geometry.shape);
  return primitive && isHalfSpace(*primitive);
}

/// Whether a body's field and shell are made, as far as its pairs need them: without, these have verdicts, distances
/// and depths, but no forces.
enum class Forces {
  kKnown,     ///< they are made
  kAwaited,   ///< they are made later
  kUnwanted,  ///< they are not made
  kFailed,    ///< they could not be made
};

/// Why there are none, such as "its field and shell are being built"; empty if they are known.
const char* whyNoForces(Forces forces);

/// What is to know of a body besides its geometry. Bodies of equal geometry differ in nothing else.
struct BodyPlace {
  std::string name;
  std::string frame;                              ///< the tf frame that carries it
  Isometry3d X_frame_B = Isometry3d::Identity();  ///< its frame B in that frame
  std::string failure;                            ///< why the body cannot be checked; empty if it can
  bool is_world = false;                          ///< an object of the world, not a link
  std::string map;                                ///< the map that the body is a tile of; empty if it is none
  Forces forces = Forces::kKnown;
};

/// Whether all is equal, poses to the last bit.
inline bool operator==(const BodyPlace& a, const BodyPlace& b) {
  return a.name == b.name && a.frame == b.frame && a.X_frame_B.matrix() == b.X_frame_B.matrix() &&
         a.failure == b.failure && a.is_world == b.is_world && a.map == b.map && a.forces == b.forces;
}

/// A rigid body: a robot's link or an object of the world.
struct BodyDescription : BodyPlace {
  std::vector<GeometryDescription> geometry;

  bool is_attached = false;  ///< an object that a link carries: it is also checked against objects of the world at rest

  /// The first of the links that only fixed joints join to the body's frame, and the frame in it. Bodies of the same
  /// one do not move relative to each other. Empty if no such link is known. See setRigidRoots().
  std::string rigid_root;
  Isometry3d X_root_frame = Isometry3d::Identity();
};

/// Why a pair is not checked. Of several reasons, the first of these counts.
enum class PairKind {
  kRequest,     ///< a rule of update_scene
  kTouchLinks,  ///< attached, and allowed by its touch_links
  kUser,        ///< the parameter allowed_pairs, or a caller of the library
  kSrdf,
  kRigid,       ///< rigidly joined, or in the same frame
  kAdjacent,    ///< joined by one movable joint
  kEmpty,       ///< one of them has no geometry
  kNever,       ///< learned: they are apart in all states
  kAlways,      ///< they overlap at rest, and overlap, or as neighbours touch, in all other states
  kHeld,        ///< the same, but at rest they touch as neighbours
  kAtRest,      ///< they overlap at rest
  kHeldAtRest,  ///< at rest they touch as neighbours
  kMayAtRest    ///< they may overlap at rest
};

/// How two bodies are that do not move relative to each other.
struct RigidPose {
  Isometry3d X_AB;
  BoundingBall ball_a, ball_b;  ///< contain their geometry, each in its body's frame; infinite for half-spaces
};

/// A decision about a pair: it is left out of a scene, and why.
struct PairDecision {
  std::string body_a, body_b;  ///< names
  std::string text = {};       ///< for people: "SRDF: Adjacent", "adjacent", …
  PairKind kind = PairKind::kUser;
  double depth = 0.0;                           ///< if they overlap at rest: of the deepest point found there [m]
  std::shared_ptr<const RigidPose> rigid = {};  ///< of kRigid
  int a = -1, b = -1;                           ///< the bodies of a planned scene, by index
};

/// A pair that a scene leaves out although it needs a check.
struct UncheckedPair {
  int body_a = -1, body_b = -1;  ///< in SceneDescription::bodies
  std::string reason;
};

/// Bodies, and the pairs of them that need no check.
struct SceneDescription {
  std::vector<BodyDescription> bodies;  ///< names are unique
  std::vector<PairDecision> allowed;    ///< the allowed collision matrix: these pairs may collide and are not checked
  std::vector<std::string> visual_only = {};  ///< links without body: they have a visual, but no collision shape
  /// Tiles of a live map are part of the scene, or may be of one that follows. What links and attached objects fill of
  /// the map is known by their fields and surfaces, which are kept even if no pair needs them.
  bool has_live_map = false;
};

struct BodySurface;
struct BodyTriangles;
class DepthSolid;
struct PointShell;
struct SphereTree;
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
  Body();  ///< without geometry

  std::string warning;          ///< about the inside of its meshes (see warningOf()); empty if there is none
  std::vector<BodyPart> parts;  ///< empty if no pair needs its field
  /// Points of the surface, frame B, and their tree; none if no pair needs them, or deep inside a sibling part.
  ///@{
  std::shared_ptr<const PointShell> shell;
  std::shared_ptr<const SphereTree> tree;
  ///@}
  std::shared_ptr<const BodySurface> surface;      ///< for voxels of a live map that are those of the body; else null
  std::shared_ptr<const BodyTriangles> triangles;  ///< of its bounded elements, which decide verdicts
  std::vector<BodyHalfSpace> half_spaces;          ///< its unbounded elements, which do so, too
  /// Of its bounded elements, in which depths are measured; null where it is not certain (an open mesh, voxels), and of
  /// a large mesh whose forces are awaited.
  std::shared_ptr<const DepthSolid> solid;
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

/// Whether a part of a body is there.
enum class PartState {
  kNotNeeded,  ///< no pair needs it, or the body can have none
  kReady,
  kAwaited,   ///< it is made later, as Forces::kAwaited, or the body comes later
  kUnwanted,  ///< as Forces::kUnwanted
  kFailed,
};

/// What is known of a part.
struct PartReport {
  PartState state = PartState::kNotNeeded;
  std::string
      text;  ///< of a field that is ready "cached", "built 1.2 s", "exact" or "shared"; else why it is not ready
};

/// The parts of a body: verdicts need its surface only; fields and shells find forces, and times and depths of
/// contacts.
struct PartReports {
  PartReport surface, field, shell;
};

/// What was built for one body; a row of the plan's table.
struct BodyReport : PartReports {
  std::string name;
  std::string geometry;         ///< "mesh (300 triangles, closed)", "box", …
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
  auto begin() const { return Iterator{bodies_.data()}; }
  auto end() const { return Iterator{bodies_.data() + bodies_.size()}; }
  ///@}

  /// The body itself, to be put into another list.
  const Shared& shared(std::size_t i) const { return bodies_[i]; }

  /// Adds a body: a new one, or one that other lists hold, too.
  ///@{
  void push_back(Body body) { bodies_.push_back(std::make_shared<const Body>(std::move(body))); }
  void push_back(Shared body) { bodies_.push_back(std::move(body)); }
  ///@}

 private:
  /// Over bodies, not over pointers to them.
  struct Iterator {
    using iterator_category = std::forward_iterator_tag;
    using value_type = Body;
    using difference_type = std::ptrdiff_t;
    using pointer = const Body*;
    using reference = const Body&;

    const Body& operator*() const { return **at; }
    const Body* operator->() const { return at->get(); }
    Iterator& operator++() { return ++at, *this; }
    bool operator==(const Iterator& other) const { return at == other.at; }
    bool operator!=(const Iterator& other) const { return at != other.at; }

    const Shared* at;
  };

  std::vector<Shared> bodies_;
};

/// Parts of a body to build.
struct BodyNeeds {
  bool field = true;
  bool shell = true;
  bool triangles = false;  ///< Body::triangles
  bool surface = false;    ///< Body::surface

  /// Whether anything of it is needed.
  bool any() const { return field || shell || triangles || surface; }
};

/// Required accuracy of bodies that are prepared for checks.
struct Accuracy {
  double max_error = 1e-3;           ///< of a verdict about two bodies, without the error of motions [m]
  std::string cache_directory = {};  ///< of the cache of fields and shells; empty: no cache
};

/// How bodies are built. The default has the field of a default Accuracy, and shell points every centimetre.
///
/// Before anything is built, the fields' bands are widened to 1.1 × (shell.spacing, or edge_gap if there is one, + the
/// field's own error + motion_margin), so that they contain the margin below which a pair is not CLEAR; at most to 32
/// cells, beyond which the bounds that fields have everywhere are accurate enough.
struct BodyOptions {
  FieldOptions field;
  ShellOptions shell;

  /// Number of shell points and field cells along the square root of an element's surface area. Spacing and cells are
  /// at least a millimetre; beyond shell.spacing and field.cell_size they grow by the fourth root of the size only,. 0:
  /// always shell.spacing and field.cell_size.
  double points_across = 0.0, cells_across = 0.0;

  double motion_margin = 1e-3;  ///< chord tolerance and motion errors to allow for in the bands [m]
  double motion_error = 0.0;    ///< part of motion_margin: motion error of two bodies, without chords [m]
  std::string cache_directory;  ///< empty: nothing is read or written

  /// Whether data of equal content, made with equal options, is shared with all bodies of this process, and not only
  /// with those of the same scene: several monitors in one nodelet manager then hold it once.
  bool is_shared = false;

  std::optional<double> max_error;  ///< required bound of every verdict [m]; the plan says whether it is met

  /// Time that preparing a body may take, at any number of threads [s]. A body that takes longer fails, by name, as do
  /// bodies of the same meshes; the others are prepared. Infinite: no limit.
  double max_preparation_time = std::numeric_limits<double>::infinity();

  /// Whether field, shell and motion_margin are shares of max_error. If they follow the elements' sizes instead, a
  /// field or shell that would be too large is made coarser, and its body's report says so; if they are shares, at most
  /// twice as coarse, beyond which buildScene() fails. Else the body cannot be checked.
  bool divides_max_error = false;
};

/// Fields and shells for contacts alone, where triangles decide the verdicts.
/// @param accuracy  maximum distance from a surface location to a point that produces forces; field cells are 1.2
/// times that [m]. None: by the sizes of the elements, at most 5 mm.
BodyOptions optionsForContacts(const std::optional<double>& accuracy = {});

/// Limits of a body's field and shell, whatever the required accuracy.
///@{
constexpr std::size_t kMaxFieldBytes = std::size_t{256} << 20, kMaxShellPoints = 3'000'000;
///@}

/// The options that meet an accuracy: its max_error is divided among field, edges and motions as 55 : 35 : 9, with the
/// limits kMaxFieldBytes and kMaxShellPoints.
/// @throws std::invalid_argument if it is below a nanometre.
BodyOptions optionsFor(const Accuracy& accuracy);

/// A body with everything that checks can use: field, shell and its tree, triangles. For whole robots and worlds
/// buildScene() builds less, because it knows the pairs.
///
/// Curved surfaces have a point every third of max_error, flat ones have points along their edges: a ball of 0.1 m
/// takes 400,000 points and several seconds at 1 mm, a hundredth of that at 1 cm.
/// @throws std::invalid_argument if the shape is not valid, or the accuracy needs more memory than a body may take:
/// kMaxFieldBytes of field, kMaxShellPoints. A mesh's shell that would have too many points is refused before its field
/// is built.
Body prepareBody(const std::string& name, const Primitive& primitive, const Accuracy& accuracy);

/// The same for a mesh, in its frame. Its faces are oriented outward, and openings are closed.
Body prepareBody(const std::string& name, const TriangleMesh& mesh, const Accuracy& accuracy);

/// The same for several elements. @throws std::invalid_argument also if the description has a failure.
Body prepareBody(const BodyDescription& description, const Accuracy& accuracy);

}  // namespace sdf_ccd
