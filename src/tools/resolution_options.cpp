#include "resolution_options.h"

#include <stdexcept>

namespace sdf_ccd::tools {
namespace {

constexpr int kDefaultCells = 64;

}  // namespace

bool hasResolution(const FieldOptions& options) {
  return options.cells || options.cell_size || options.max_error;
}

void ResolutionOptions::addTo(CLI::App& command) {
  resolution_option_ =
      command.add_option("--resolution", cells,
                         "Cells along the longest side of the surface's box; if none is given 64, and more where "
                         "walls are too thin for that, up to a field of 256 MB");
  cell_option_ = command.add_option("--cell", cell_size, "Size of a cell [m]");
  max_error_option_ = command.add_option("--max-error", max_error, "Maximum error of distances near the surface [m]");
  resolution_option_->excludes(cell_option_)->excludes(max_error_option_);
  cell_option_->excludes(max_error_option_);
  band_option_ =
      command.add_option("--band", band, "Distances are accurate up to this from the surface [m]; at least two cells");
}

void ResolutionOptions::requireNone(const std::string& reason) const {
  for (const CLI::Option* option : {resolution_option_, cell_option_, max_error_option_, band_option_}) {
    if (option->count()) throw std::invalid_argument(option->get_name() + " sets how a field is built, but " + reason);
  }
}

FieldOptions ResolutionOptions::given() const {
  FieldOptions options;
  options.band = band;
  if (resolution_option_->count()) options.cells = cells;
  if (cell_option_->count()) options.cell_size = cell_size;
  if (max_error_option_->count()) options.max_error = max_error;
  return options;
}

FieldOptions ResolutionOptions::fieldOptions(std::optional<double> default_cell) const {
  FieldOptions options = given();
  if (!hasResolution(options)) {
    options.cell_size = default_cell;
    if (!default_cell) options.cells = kDefaultCells;
  }
  validate(options);
  return options;
}

}  // namespace sdf_ccd::tools
