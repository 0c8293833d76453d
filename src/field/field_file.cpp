#include "sdf_ccd/field.h"

#include <stdexcept>

#include "caps_file.h"
#include "common/files/checked_file.h"
#include "field/adaptive/adaptive_file.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/lost_surface.h"
#include "field/uniform/sparse_grid.h"
#include "grid_record.h"

namespace sdf_ccd {
namespace {

constexpr char kKind[] = "field";
constexpr std::uint32_t kVersion = 10;

struct UniformRecord {
  GridRecord grid;
  double step;  ///< GridShape::step
};
static_assert(sizeof(UniformRecord) == 128, "the file's layout must not depend on the compiler");

}  // namespace

void saveField(const DistanceField& field, const std::string& path, const std::string& key) {
  saveField(field, path, key, std::nullopt);
}

void saveField(const DistanceField& field, const std::string& path, const std::string& key,
               const std::optional<LostSurface>& lost) {
  if (const AdaptiveGrid* adaptive = FieldAccess::adaptive(field))
    return saveAdaptive(*adaptive, field, path, key, lost);
  const SparseGrid* grid = FieldAccess::grid(field);
  if (!grid) throw std::invalid_argument(path + ": the field of a primitive is exact and needs no file");
  const GridShape& shape = grid->shape();
  const UniformRecord record{gridRecord(shape, shape.bricks, grid->errorBound(), GridShape::kBrick, field.moved()),
                             shape.step};
  std::vector<FileSection> sections = {
      {&record, sizeof record}, sectionOf(grid->corners()), sectionOf(grid->words()), sectionOf(grid->samples())};
  addCaps(FieldAccess::openings(field), sections);
  addLost(lost, sections);
  writeCheckedFile(path, {kKind, kVersion, key}, sections);
}

bool isFieldFile(const std::string& path) {
  return isCheckedFile(path, kKind) || isCheckedFile(path, kAdaptiveFileKind);
}

DistanceField loadField(const std::string& path, const std::string& key) {
  if (isCheckedFile(path, kAdaptiveFileKind)) return loadAdaptive(path, key);
  const std::shared_ptr<const CheckedFile> file = CheckedFile::open(path, {kKind, kVersion, key});
  std::size_t records = 0;
  const auto* record = file->section<UniformRecord>(0, records);
  if (records != 1 || record->grid.divisions != GridShape::kBrick) {
    throw std::runtime_error(path + ": damaged: its header is not valid for this layout");
  }
  GridShape shape;
  setShape(record->grid, shape, shape.bricks);
  shape.step = record->step;
  SparseGrid::Arrays arrays;
  arrays.corners.data = file->section<float>(1, arrays.corners.size);
  arrays.words.data = file->section<std::uint32_t>(2, arrays.words.size);
  arrays.samples.data = file->section<std::int16_t>(3, arrays.samples.size);
  try {
    return FieldAccess::make(std::make_shared<const SparseGrid>(shape, arrays, record->grid.error_bound, file),
                             loadCaps(*file, 4, shape.surface_box), record->grid.moved);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": damaged: " + error.what());
  }
}

std::optional<LostSurface> loadLostSurface(const std::string& path) {
  if (isCheckedFile(path, kAdaptiveFileKind)) return loadLostOfAdaptive(path);
  return lostIn(*CheckedFile::open(path, {kKind, kVersion}), 7, path);
}

}  // namespace sdf_ccd
