#include "adaptive_file.h"

#include <stdexcept>

#include "field/adaptive/adaptive_grid.h"
#include "field/caps_file.h"
#include "field/field_access.h"
#include "field/grid_record.h"

namespace sdf_ccd {
namespace {

constexpr std::uint32_t kVersion = 10;

static_assert(sizeof(NodeBases) == 12 && sizeof(AdaptiveNode) == 64 && sizeof(SplitLeaves) == 64,
              "the file's layout must not depend on the compiler");

}  // namespace

void saveAdaptive(const AdaptiveGrid& grid, const DistanceField& field, const std::string& path, const std::string& key,
                  const std::optional<LostSurface>& lost) {
  const AdaptiveShape& shape = grid.shape();
  const GridRecord record = gridRecord(shape, shape.size, shape.error_bound, AdaptiveShape::kUnits, field.moved());
  const AdaptiveGrid::Arrays& arrays = grid.arrays();
  std::vector<FileSection> sections = {{&record, sizeof record},     sectionOf(arrays.top),    sectionOf(arrays.nodes),
                                       sectionOf(arrays.bases),      sectionOf(arrays.leaves), sectionOf(arrays.splits),
                                       sectionOf(arrays.leaf_errors)};
  addCaps(FieldAccess::openings(field), sections);
  addLost(lost, sections);
  writeCheckedFile(path, {kAdaptiveFileKind, kVersion, key}, sections);
}

DistanceField loadAdaptive(const std::string& path, const std::string& key) {
  const std::shared_ptr<const CheckedFile> file = CheckedFile::open(path, {kAdaptiveFileKind, kVersion, key});
  std::size_t records = 0;
  const auto* record = file->section<GridRecord>(0, records);
  if (records != 1 || record->divisions != AdaptiveShape::kUnits) {
    throw std::runtime_error(path + ": damaged: its header is not valid for this layout");
  }
  AdaptiveShape shape;
  setShape(*record, shape, shape.size);
  shape.error_bound = record->error_bound;
  AdaptiveGrid::Arrays arrays;
  arrays.top.data = file->section<std::uint32_t>(1, arrays.top.size);
  arrays.nodes.data = file->section<AdaptiveNode>(2, arrays.nodes.size);
  arrays.bases.data = file->section<NodeBases>(3, arrays.bases.size);
  arrays.leaves.data = file->section<LeafWord>(4, arrays.leaves.size);
  arrays.splits.data = file->section<SplitLeaves>(5, arrays.splits.size);
  arrays.leaf_errors.data = file->section<std::uint8_t>(6, arrays.leaf_errors.size);
  try {
    return FieldAccess::make(std::make_shared<const AdaptiveGrid>(shape, arrays, file),
                             loadCaps(*file, 7, shape.surface_box), record->moved);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": damaged: " + error.what());
  }
}

std::optional<LostSurface> loadLostOfAdaptive(const std::string& path) {
  return lostIn(*CheckedFile::open(path, {kAdaptiveFileKind, kVersion}), 10, path);
}

}  // namespace sdf_ccd
