#include "mesh/unit_hint.h"

#include "common/number_text.h"

namespace sdf_ccd {

std::string unitHint(const TriangleMesh& mesh) {
  constexpr double kLong = 50.0;  // [m]
  const AlignedBox3d box = boundingBox(mesh);
  const double length = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (!(length > kLong)) return {};
  return numberText(length) + " m long: is it in millimetres? Meshes are taken to be in metres, times their scale";
}

}  // namespace sdf_ccd
