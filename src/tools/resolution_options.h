#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "mesh_field.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::tools {

/// Whether the options say how fine a field is.
bool hasResolution(const FieldOptions& options);

/// The options for the resolution of a field.
struct ResolutionOptions {
  int cells = 0;
  double cell_size = 0.0;
  double max_error = 0.0;
  double band = 0.0;

  /// Adds --resolution, --cell, --max-error and --band.
  void addTo(CLI::App& command);

  /// @throws std::invalid_argument, naming the option and the reason, if one was given although no field is built.
  void requireNone(const std::string& reason) const;

  /// The options given on the command line: at most one resolution.
  FieldOptions given() const;

  /// The same; without a resolution, cells of `default_cell` [m], or 64 cells along the longest side.
  /// @throws std::invalid_argument if a value is invalid.
  FieldOptions fieldOptions(std::optional<double> default_cell = std::nullopt) const;

  /// Without a resolution, thin walls are kept by smaller cells than the default.
  ThinWalls thinWalls() const { return hasResolution(given()) ? ThinWalls::kReport : ThinWalls::kKeep; }

 private:
  CLI::Option* resolution_option_ = nullptr;
  CLI::Option* cell_option_ = nullptr;
  CLI::Option* max_error_option_ = nullptr;
  CLI::Option* band_option_ = nullptr;
};

}  // namespace sdf_ccd::tools
