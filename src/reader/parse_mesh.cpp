#include "parse_mesh.h"

#include <stdexcept>

#include "mesh_formats.h"

namespace sdf_ccd {
namespace {

TriangleMesh parse(const std::string& bytes, const std::string& format) {
  if (format == "stl") return parseStl(bytes);
  if (format == "obj") return parseObj(bytes);
  if (format == "off") return parseOff(bytes);
  if (format == "ply") return parsePly(bytes);
  if (format == "dae") return parseDae(bytes);
  throw std::runtime_error("a mesh of format \"" + format + "\" is not read; STL, OBJ, OFF, PLY and DAE are");
}

}  // namespace

TriangleMesh parseMeshUnconfined(const std::string& bytes, const std::string& format) {
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";  // some editors write it before a text
  if (bytes.empty()) throw std::runtime_error("empty");
  const bool has_mark = bytes.rfind(kByteOrderMark, 0) == 0;
  TriangleMesh mesh = welded(has_mark ? parse(bytes.substr(3), format) : parse(bytes, format));
  validate(mesh);
  return mesh;
}

}  // namespace sdf_ccd
