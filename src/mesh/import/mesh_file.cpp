#include "sdf_ccd/mesh.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "common/files/regular_file.h"
#include "common/shown_text.h"
#include "mesh/import/read_apart.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kLongestEnding = 10;

std::string ending(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::size_t slash = name.find_last_of("/\\");
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return "";
  std::string result = name.substr(dot + 1, kLongestEnding);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return result;
}

TriangleMesh parse(const std::string& bytes, const std::string& name) {
  if (bytes.empty()) throw std::runtime_error("empty");
  if (bytes.size() > kMaxFileBytes) throw std::runtime_error("larger than 1 GiB");
  const std::string format = ending(name);
  if (format.empty()) throw std::runtime_error("the file name has no extension, so the format is unknown");
  for (const char* known : {"stl", "obj", "off", "ply", "dae"}) {
    if (format == known) return readSandboxed(format, bytes).mesh;
  }
  throw std::runtime_error("unsupported file extension; supported: .stl, .obj, .off, .ply, .dae");
}

}  // namespace

TriangleMesh parseMesh(const std::string& bytes, const std::string& name) {
  try {
    return parse(bytes, name);
  } catch (const std::exception& error) {
    throw std::runtime_error(shownText(name) + ": " + error.what());
  }
}

TriangleMesh loadMesh(const std::string& path) {
  try {
    return parse(readRegularFile(path), path);
  } catch (const std::exception& error) {
    throw std::runtime_error(shownText(path) + ": " + error.what());
  }
}

}  // namespace sdf_ccd
