#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/mesh/triangle_mesh.h"
#include "sdf_ccd/scene/body.h"
#include "sdf_ccd/scene/scene_description.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

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

  /// Whether meshes that are decided by triangles keep their solids for measuring depths: CycleRequest::refine. This
  /// takes several times the memory of the mesh.
  bool exact_depths = false;

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
