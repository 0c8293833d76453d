#pragma once

#include <memory>
#include <vector>

#include "common/files/checked_file.h"
#include "field/opening_caps.h"

namespace sdf_ccd {

/// Appends a field's caps as the last sections of its file: vertices, triangles, reaches; empty if `caps` is null.
void addCaps(const OpeningCaps* caps, std::vector<FileSection>& sections);

/// Reads the caps that addCaps() wrote; null if there are none.
/// @param first        index of the first of the three sections.
/// @param surface_box  of the field; the caps must lie in it [m].
/// @throws std::invalid_argument if the sections do not hold valid caps.
std::shared_ptr<const OpeningCaps> loadCaps(const CheckedFile& file, std::size_t first,
                                            const AlignedBox3d& surface_box);

}  // namespace sdf_ccd
