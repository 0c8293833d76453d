#include "caps_file.h"

#include <stdexcept>

namespace sdf_ccd {

static_assert(sizeof(Vector3d) == 24 && sizeof(Vector3i) == 12, "the file's layout must not depend on the compiler");

void addCaps(const OpeningCaps* caps, std::vector<FileSection>& sections) {
  if (!caps) {
    sections.insert(sections.end(), 3, FileSection{nullptr, 0});
    return;
  }
  sections.push_back(sectionOf(viewOf(caps->mesh().vertices)));
  sections.push_back(sectionOf(viewOf(caps->mesh().triangles)));
  sections.push_back(sectionOf(viewOf(caps->reach())));
}

std::shared_ptr<const OpeningCaps> loadCaps(const CheckedFile& file, std::size_t first,
                                            const AlignedBox3d& surface_box) {
  std::size_t vertices = 0, triangles = 0, reaches = 0;
  const auto* vertex = file.section<double>(first, vertices);
  const auto* corner = file.section<std::int32_t>(first + 1, triangles);
  const auto* reach = file.section<double>(first + 2, reaches);
  if (vertices == 0 && triangles == 0 && reaches == 0) return nullptr;
  if (vertices % 3 != 0 || triangles % 3 != 0)
    throw std::invalid_argument("the caps' coordinates or indices are incomplete");
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices; i += 3) mesh.vertices.emplace_back(vertex[i], vertex[i + 1], vertex[i + 2]);
  for (std::size_t i = 0; i < triangles; i += 3) mesh.triangles.emplace_back(corner[i], corner[i + 1], corner[i + 2]);
  auto caps = std::make_shared<const OpeningCaps>(std::move(mesh), std::vector<double>(reach, reach + reaches));
  for (const Vector3d& p : caps->mesh().vertices) {
    if (!surface_box.contains(p)) throw std::invalid_argument("caps lie outside the surface's box");
  }
  return caps;
}

}  // namespace sdf_ccd
