#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/shell/sample_surface.h"

namespace sdf_ccd {

/// What is wanted of bodies that are prepared to be checked.
struct Accuracy {
  double max_error = 1e-3;           ///< of a verdict about two of them, but for what motions add [m]
  std::string cache_directory = {};  ///< where what was made is kept, and found again; empty: nowhere
};

/// The fields' bands are widened, before anything is built, to 1.1 × (shell.spacing, or edge_gap if there is
/// one, + the field's own error + motion_margin), so that they hold the margin at which a pair ceases to be CLEAR; at
/// most to 32 cells, beyond which the bounds that every field has anywhere are fine enough.
struct BodyOptions {
  FieldOptions field;
  ShellOptions shell;

  /// How many points of its shell, and cells of its field, an element has across the root of its surface's area; a
  /// millimetre apart where it is small, shell.spacing and field.cell_size where it is large. 0: these everywhere.
  double points_across = 0.0, cells_across = 0.0;

  double motion_margin = 1e-3;  ///< chord tolerance and motion errors to allow for in the bands [m]
  double motion_error = 0.0;    ///< of it what two bodies' motions are off by, whatever the chords [m]
  std::string cache_directory;  ///< empty: nothing is read or written

  /// Whether meshes that triangles decide about keep their solids, to measure depths on: CycleRequest::refine. It takes
  /// memory like the mesh some times over.
  bool exact_depths = false;

  /// Whether what other bodies of this process have of the same content, made with the same options, is shared with
  /// them: several monitors in one nodelet manager hold it once.
  bool is_shared = false;

  std::optional<double> max_error;  ///< the bound wanted of every verdict [m]; the plan says whether it is kept

  /// Whether field, shell and motion_margin are shares of max_error. If they are, or follow the elements' sizes, a
  /// field or shell that would be too large is made coarser, and its body's report says so; else the body cannot be
  /// checked.
  bool is_shared_out = false;
};

/// Fields and shells for contacts alone, where triangles decide the verdicts.
/// @param accuracy  no location of a surface is farther than this from a point that bears forces, and a field's cells
/// are four fifths of it [m]; none: as fine as the elements are small, at most 5 mm.
BodyOptions optionsForContacts(const std::optional<double>& accuracy = {});

/// What a body's field and shell may take where an accuracy is wanted, whatever that is.
constexpr std::size_t kMostFieldBytes = std::size_t{256} << 20, kMostShellPoints = 3'000'000;

/// The options that keep an accuracy: its max_error shared out to field, edges and motions as 55 : 35 : 9, with
/// kMostFieldBytes and kMostShellPoints.
/// @throws std::invalid_argument if it is below a nanometre.
BodyOptions optionsFor(const Accuracy& accuracy);

}  // namespace sdf_ccd
