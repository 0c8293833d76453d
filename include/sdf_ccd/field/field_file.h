#pragma once

#include <string>

#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd {

/// Writes a sampled field. The file appears under its name complete or not at all, and ends in a checksum.
/// @param key  what the field was made from, up to 63 characters, for whoever loads it to ask for.
/// @throws std::invalid_argument for a primitive's field, which is exact and needs no file; std::runtime_error naming
/// the path and the reason.
void saveField(const DistanceField& field, const std::string& path, const std::string& key = {});

/// Reads a field file.
/// @param key  if not empty, the file must have been saved with the same.
/// @throws std::runtime_error naming the path and what is wrong with the file.
DistanceField loadField(const std::string& path, const std::string& key = {});

/// True if the file begins like one of saveField().
bool isFieldFile(const std::string& path);

}  // namespace sdf_ccd
