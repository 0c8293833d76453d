#include "octree_file.h"

#include <bitset>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxDepth = 16;

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

template <class T>
T readAt(const std::string& bytes, std::size_t offset) {
  T value;
  if (offset + sizeof(T) > bytes.size()) throw std::runtime_error("truncated within its head");
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// Layout: int32 with the value 3, double resolution, uint32 number of nodes.
OctreeFile readLegacyHead(const std::string& bytes) {
  OctreeFile file;
  file.format = OctreeFile::Format::kLegacyBinary;
  if (bytes.size() < 4 || readAt<std::int32_t>(bytes, 0) != 3) throw std::runtime_error("not an OctoMap file");
  file.resolution = readAt<double>(bytes, 4);
  file.nodes = readAt<std::uint32_t>(bytes, 12);
  file.data_offset = 16;
  return file;
}

/// Reads the lines `id OcTree`, `size 123`, `res 0.1` and comments, up to the line `data`.
OctreeFile readHead(const std::string& bytes, OctreeFile::Format format) {
  OctreeFile file;
  file.format = format;
  for (std::size_t begin = 0; begin < bytes.size();) {
    std::size_t end = bytes.find('\n', begin);
    if (end == std::string::npos) break;
    std::istringstream line(bytes.substr(begin, end - begin));
    line.imbue(std::locale::classic());
    std::string word;
    line >> word;
    begin = end + 1;
    if (word == "data") {
      file.data_offset = begin;
      return file;
    }
    if (word == "id") line >> file.type;
    if (word == "size") line >> file.nodes;
    if (word == "res") line >> file.resolution;
    if (line.fail() && !word.empty()) throw std::runtime_error("the header has no value for " + word);
  }
  throw std::runtime_error("truncated within its head");
}

struct Children {
  std::size_t all;      ///< that the header's number of nodes counts
  std::size_t written;  ///< that follow in the file as nodes
};

/// A node has two bytes, two bits per child: 00 unknown, 01 and 10 a leaf, 11 a node that follows in the file.
Children childrenInBinary(const unsigned char* node) {
  Children children{0, 0};
  for (int i = 0; i < 8; ++i) {
    const int bits = (node[i / 4] >> (2 * (i % 4))) & 3;
    children.all += bits != 0;
    children.written += bits == 3;
  }
  return children;
}

/// A node's last byte has one bit per child; all children follow in the file.
Children childrenInFull(const unsigned char* node, std::size_t node_bytes) {
  const std::size_t count = std::bitset<8>(node[node_bytes - 1]).count();
  return {count, count};
}

void walk(const std::string& bytes, const OctreeFile& file) {
  const bool full = file.format == OctreeFile::Format::kFull;
  const std::size_t node_bytes = !full ? 2 : file.type == "ColorOcTree" ? 4 + 3 + 1 : 4 + 1;
  std::size_t offset = file.data_offset;
  std::size_t nodes = 1;
  std::vector<std::size_t> to_come = {1};  // per level: nodes not yet read
  while (!to_come.empty()) {
    if (to_come.back() == 0) {
      to_come.pop_back();
      continue;
    }
    --to_come.back();
    if (offset + node_bytes > bytes.size()) {
      throw std::runtime_error("truncated: it ends after " + std::to_string(bytes.size()) + " bytes, within its nodes");
    }
    const auto* node = reinterpret_cast<const unsigned char*>(bytes.data()) + offset;
    const Children children = full ? childrenInFull(node, node_bytes) : childrenInBinary(node);
    if (children.all > 0 && to_come.size() > kMaxDepth) {
      throw std::runtime_error("damaged: more than 16 levels at byte " + std::to_string(offset));
    }
    offset += node_bytes;
    nodes += children.all;
    to_come.push_back(children.written);
  }
  if (nodes != file.nodes) {
    throw std::runtime_error("damaged: the header announces " + std::to_string(file.nodes) + " nodes, the file has " +
                             std::to_string(nodes));
  }
}

}  // namespace

OctreeFile checkOctreeFile(const std::string& bytes) {
  const bool binary = startsWith(bytes, "# Octomap OcTree binary file");
  const bool full = startsWith(bytes, "# Octomap OcTree file");
  const OctreeFile file = binary ? readHead(bytes, OctreeFile::Format::kBinary)
                          : full ? readHead(bytes, OctreeFile::Format::kFull)
                                 : readLegacyHead(bytes);
  if (!std::isfinite(file.resolution) || file.resolution <= 0.0) {
    throw std::runtime_error("its resolution is " + numberText(file.resolution) + " m");
  }
  if (full && file.type != "OcTree" && file.type != "ColorOcTree") {
    throw std::runtime_error("it holds a tree of type " + file.type + "; only OcTree and ColorOcTree are read");
  }
  if (file.nodes > 0) walk(bytes, file);
  return file;
}

std::string withPlainHead(const OctreeFile& file, const std::string& bytes) {
  if (file.format == OctreeFile::Format::kLegacyBinary) return bytes;
  std::ostringstream head;
  head.imbue(std::locale::classic());
  head.precision(std::numeric_limits<double>::max_digits10);
  head << (file.format == OctreeFile::Format::kFull ? "# Octomap OcTree file" : "# Octomap OcTree binary file")
       << "\nid " << file.type << "\nsize " << file.nodes << "\nres " << file.resolution << "\ndata\n";
  return head.str() + bytes.substr(file.data_offset);
}

}  // namespace sdf_ccd
