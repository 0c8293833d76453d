#include "field/source_field.h"

#include "field/voxel_field.h"

namespace sdf_ccd {
namespace {

bool isLattice(const SolidSource& source, const FieldOptions& options) {
  return source.voxels() && canBeLattice(*source.voxels(), options);
}

}  // namespace

DistanceField buildField(const SolidSource& source, const FieldOptions& options, const Progress& progress) {
  return isLattice(source, options) ? buildField(*source.voxels(), options, progress)
                                    : buildField(source.closed(), options, progress);
}

FieldCost expectedCost(const SolidSource& source, const FieldOptions& options) {
  return isLattice(source, options) ? expectedCost(*source.voxels(), options) : expectedCost(source.closed(), options);
}

}  // namespace sdf_ccd
