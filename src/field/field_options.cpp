#include "sdf_ccd/field.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "common/number_text.h"
#include "field/build_field.h"

namespace sdf_ccd {

void validate(const FieldOptions& options) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("field options: " + what); };
  const int given = options.cells.has_value() + options.cell_size.has_value() + options.max_error.has_value();
  if (given > 1) fail("give at most one of cells, cell_size and max_error; " + std::to_string(given) + " are given");
  if (options.cells && (*options.cells < 1 || *options.cells > 16384)) {
    fail("cells must be from 1 to 16384, not " + std::to_string(*options.cells));
  }
  const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
  if (options.cell_size && !positive(*options.cell_size)) {
    fail("cell_size must be finite and positive, not " + numberText(*options.cell_size));
  }
  if (options.max_error && !positive(*options.max_error)) {
    fail("max_error must be finite and positive, not " + numberText(*options.max_error));
  }
  if (!std::isfinite(options.band) || options.band < 0.0) {
    fail("band must be finite and not negative, not " + numberText(options.band));
  }
}

FieldOptions withResolution(FieldOptions options) {
  validate(options);
  if (!options.cells && !options.cell_size && !options.max_error) options.max_error = FieldOptions::kDefaultMaxError;
  return options;
}

}  // namespace sdf_ccd
