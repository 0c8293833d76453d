#pragma once

#include <string>

namespace sdf_ccd::precision {

/// True if gnuplot can be run here.
bool haveGnuplot();

/// Runs gnuplot; the script is written to the directory for temporary files (TMPDIR).
/// @throws std::runtime_error if that or gnuplot fails.
void runGnuplot(const std::string& script);

/// A text as a gnuplot string in single quotes.
std::string quoted(const std::string& text);

}  // namespace sdf_ccd::precision
