#pragma once

#include <string>

#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd {

/// Writes a sampled field; see writeCheckedFile() for what the file guarantees.
/// @throws std::invalid_argument for a primitive's field, which is exact and needs no file.
void saveField(const DistanceField& field, const std::string& path);

/// Maps a field file; samples are read from the mapping, which the field keeps open.
/// @throws std::runtime_error naming the path and what is wrong with the file.
DistanceField loadField(const std::string& path);

/// True if the file begins like one of saveField().
bool isFieldFile(const std::string& path);

}  // namespace sdf_ccd
