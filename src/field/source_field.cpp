#include "field/source_field.h"

#include "field/build_field.h"
#include "field/voxel_field.h"

namespace sdf_ccd {

DistanceField buildField(const SolidSource& source, const FieldOptions& options, const Progress& progress) {
  const bool is_lattice = source.voxels() && canBeLattice(*source.voxels(), options);
  return is_lattice ? buildField(*source.voxels(), options, progress) : buildField(source.closed(), options, progress);
}

}  // namespace sdf_ccd
