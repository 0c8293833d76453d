#include "sdf_ccd/field/field_file.h"

#include <stdexcept>

#include "caps_file.h"
#include "field/adaptive/adaptive_file.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/uniform/sparse_grid.h"
#include "storage/checked_file.h"

namespace sdf_ccd {
namespace {

constexpr char kKind[] = "field";
constexpr std::uint32_t kVersion = 7;

struct ShapeRecord {
  double origin[3];
  double cell;
  double band;
  double error_bound;
  double surface_min[3];
  double surface_max[3];
  std::int32_t bricks[3];
  std::int32_t brick_cells;  ///< cells along a brick's side, so that another layout is never misread
  double step;               ///< GridShape::step
};
static_assert(sizeof(ShapeRecord) == 120, "the file's layout must not depend on the compiler");

}  // namespace

void saveField(const DistanceField& field, const std::string& path) {
  if (const AdaptiveGrid* adaptive = field.adaptive()) return saveAdaptive(*adaptive, field.openings(), path);
  const SparseGrid* grid = field.grid();
  if (!grid) throw std::invalid_argument(path + ": the field of a primitive is exact and needs no file");
  const GridShape& shape = grid->shape();
  ShapeRecord record{};
  record.cell = shape.cell;
  record.band = shape.band;
  record.error_bound = grid->errorBound();
  record.brick_cells = GridShape::kBrick;
  record.step = shape.step;
  for (int k = 0; k < 3; ++k) {
    record.origin[k] = shape.origin[k];
    record.surface_min[k] = shape.surface_box.min()[k];
    record.surface_max[k] = shape.surface_box.max()[k];
    record.bricks[k] = shape.bricks[k];
  }
  std::vector<FileSection> sections = {
      {&record, sizeof record}, sectionOf(grid->corners()), sectionOf(grid->words()), sectionOf(grid->samples())};
  addCaps(field.openings(), sections);
  writeCheckedFile(path, kKind, kVersion, sections);
}

bool isFieldFile(const std::string& path) {
  return isCheckedFile(path, kKind) || isCheckedFile(path, kAdaptiveFileKind);
}

DistanceField loadField(const std::string& path) {
  if (isCheckedFile(path, kAdaptiveFileKind)) return loadAdaptive(path);
  const std::shared_ptr<const CheckedFile> file = CheckedFile::open(path, kKind, kVersion);
  std::size_t records = 0;
  const auto* record = file->section<ShapeRecord>(0, records);
  if (records != 1 || record->brick_cells != GridShape::kBrick) {
    throw std::runtime_error(path + ": damaged: no shape of this layout");
  }
  GridShape shape;
  shape.cell = record->cell;
  shape.band = record->band;
  shape.origin = Vector3d(record->origin);
  shape.surface_box = {Vector3d(record->surface_min), Vector3d(record->surface_max)};
  shape.bricks = Vector3i(record->bricks);
  shape.step = record->step;
  SparseGrid::Arrays arrays;
  arrays.corners.data = file->section<float>(1, arrays.corners.size);
  arrays.words.data = file->section<std::uint32_t>(2, arrays.words.size);
  arrays.samples.data = file->section<std::int16_t>(3, arrays.samples.size);
  try {
    return DistanceField(std::make_shared<const SparseGrid>(shape, arrays, record->error_bound, file),
                         loadCaps(*file, 4, shape.surface_box));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": damaged: " + error.what());
  }
}

}  // namespace sdf_ccd
