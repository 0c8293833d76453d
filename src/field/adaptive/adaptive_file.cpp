#include "adaptive_file.h"

#include <stdexcept>

#include "field/adaptive/adaptive_grid.h"
#include "field/caps_file.h"

namespace sdf_ccd {
namespace {

constexpr std::uint32_t kVersion = 7;

struct ShapeRecord {
  double origin[3];
  double cell;
  double band;
  double error_bound;
  double surface_min[3];
  double surface_max[3];
  std::int32_t size[3];
  std::int32_t units;  ///< smallest blocks along a top cell's side, so that another layout is never misread
};
static_assert(sizeof(ShapeRecord) == 112, "the file's layout must not depend on the compiler");
static_assert(sizeof(NodeBases) == 12 && sizeof(AdaptiveNode) == 64 && sizeof(SplitLeaves) == 64, "as above");

}  // namespace

void saveAdaptive(const AdaptiveGrid& grid, const OpeningCaps* openings, const std::string& path) {
  const AdaptiveShape& shape = grid.shape();
  ShapeRecord record{};
  record.cell = shape.cell;
  record.band = shape.band;
  record.error_bound = shape.error_bound;
  record.units = AdaptiveShape::kUnits;
  for (int k = 0; k < 3; ++k) {
    record.origin[k] = shape.origin[k];
    record.surface_min[k] = shape.surface_box.min()[k];
    record.surface_max[k] = shape.surface_box.max()[k];
    record.size[k] = shape.size[k];
  }
  const AdaptiveGrid::Arrays& arrays = grid.arrays();
  std::vector<FileSection> sections = {{&record, sizeof record},     sectionOf(arrays.top),    sectionOf(arrays.nodes),
                                       sectionOf(arrays.bases),      sectionOf(arrays.leaves), sectionOf(arrays.splits),
                                       sectionOf(arrays.leaf_errors)};
  addCaps(openings, sections);
  writeCheckedFile(path, kAdaptiveFileKind, kVersion, sections);
}

DistanceField loadAdaptive(const std::string& path) {
  const std::shared_ptr<const CheckedFile> file = CheckedFile::open(path, kAdaptiveFileKind, kVersion);
  std::size_t records = 0;
  const auto* record = file->section<ShapeRecord>(0, records);
  if (records != 1 || record->units != AdaptiveShape::kUnits) {
    throw std::runtime_error(path + ": damaged: no shape of this layout");
  }
  AdaptiveShape shape;
  shape.cell = record->cell;
  shape.band = record->band;
  shape.error_bound = record->error_bound;
  shape.origin = Vector3d(record->origin);
  shape.surface_box = {Vector3d(record->surface_min), Vector3d(record->surface_max)};
  shape.size = Vector3i(record->size);
  AdaptiveGrid::Arrays arrays;
  arrays.top.data = file->section<std::uint32_t>(1, arrays.top.size);
  arrays.nodes.data = file->section<AdaptiveNode>(2, arrays.nodes.size);
  arrays.bases.data = file->section<NodeBases>(3, arrays.bases.size);
  arrays.leaves.data = file->section<LeafWord>(4, arrays.leaves.size);
  arrays.splits.data = file->section<SplitLeaves>(5, arrays.splits.size);
  arrays.leaf_errors.data = file->section<std::uint8_t>(6, arrays.leaf_errors.size);
  try {
    return DistanceField(std::make_shared<const AdaptiveGrid>(shape, arrays, file),
                         loadCaps(*file, 7, shape.surface_box));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": damaged: " + error.what());
  }
}

}  // namespace sdf_ccd
