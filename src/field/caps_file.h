#pragma once

#include <memory>
#include <vector>

#include "field/opening_caps.h"
#include "storage/checked_file.h"

namespace sdf_ccd {

/// A field's caps as the last sections of its file: vertices, triangles, reaches; all empty if there are none.
void addCaps(const OpeningCaps* caps, std::vector<FileSection>& sections);

/// Reads them back; null if there are none.
/// @param first        of the three sections.
/// @param surface_box  of the field, which holds the caps [m].
/// @throws std::invalid_argument if they are none.
std::shared_ptr<const OpeningCaps> loadCaps(const CheckedFile& file, std::size_t first,
                                            const AlignedBox3d& surface_box);

}  // namespace sdf_ccd
