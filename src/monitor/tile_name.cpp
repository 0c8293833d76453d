#include "tile_name.h"

#include <cctype>

namespace sdf_ccd {

std::string tileName(const std::string& map, const Vector3i& place) {
  return map + "/" + std::to_string(place.x()) + "_" + std::to_string(place.y()) + "_" + std::to_string(place.z());
}

std::string mapOfTile(const std::string& body) {
  const std::size_t slash = body.rfind('/');
  if (slash == std::string::npos) return body;
  std::size_t at = slash + 1;
  for (int i = 0; i < 3; ++i) {
    if (i > 0 && (at >= body.size() || body[at++] != '_')) return body;
    if (at < body.size() && body[at] == '-') ++at;
    const std::size_t digits = at;
    while (at < body.size() && std::isdigit(static_cast<unsigned char>(body[at])) != 0) ++at;
    if (at == digits) return body;
  }
  return at == body.size() ? body.substr(0, slash) : body;
}

}  // namespace sdf_ccd
