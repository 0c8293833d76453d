#include "sdf_ccd/field/build_field.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace sdf_ccd {

void validate(const FieldOptions& options) {
  const auto fail = [](const std::string& what, double value) {
    throw std::invalid_argument("field options: " + what + ", not " + std::to_string(value));
  };
  const int given = options.cells.has_value() + options.cell_size.has_value() + options.max_error.has_value();
  if (given != 1) fail("exactly one of cells, cell_size and max_error must be given", given);
  if (options.cells && (*options.cells < 1 || *options.cells > 16384)) fail("cells must be 1 to 16384", *options.cells);
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  if (options.cell_size && !positive(*options.cell_size)) fail("cell_size must be positive", *options.cell_size);
  if (options.max_error && !positive(*options.max_error)) fail("max_error must be positive", *options.max_error);
  if (!std::isfinite(options.band) || options.band < 0.0) fail("band must not be negative", options.band);
}

}  // namespace sdf_ccd
