#include "octree_leaves.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace sdf_ccd {
namespace {

constexpr int kDepth = 16;

/// A node whose children are being read.
struct Open {
  std::uint32_t low[3];
  int level;  // of the node
  unsigned children;
  int next;
};

class LeafReader {
 public:
  LeafReader(const std::int8_t* data, std::size_t bytes, const std::function<void(const OctreeLeaf&)>& visit)
      : data_(reinterpret_cast<const unsigned char*>(data)), bytes_(bytes), visit_(visit) {}

  void readBinary() {
    push({0, 0, 0}, kDepth, children16());
    forEachChild([this](const Open& node, int i) {
      const unsigned bits = node.children >> (2 * i) & 3U;
      if (bits == 3) {
        push(childOf(node, i), node.level - 1, children16());
      } else if (bits != 0) {
        // OctoMap writes a free leaf as 1, an occupied one as 2.
        leaf(childOf(node, i), node.level - 1, bits == 2);
      }
    });
  }

  void readFull(std::size_t colour) {
    readNode({0, 0, 0}, kDepth, colour);
    forEachChild([this, colour](const Open& node, int i) {
      if ((node.children >> i & 1U) != 0) readNode(childOf(node, i), node.level - 1, colour);
    });
  }

  void requireEnd() const {
    if (at_ != bytes_) fail("continues after the tree's end");
  }

 private:
  struct Corner {
    std::uint32_t low[3];
  };

  /// Calls read(node, i) for child i of each open node, also of those that it opens.
  template <typename Read>
  void forEachChild(const Read& read) {
    while (depth_ > 0) {
      Open& node = open_[depth_ - 1];
      if (node.next == 8) {
        --depth_;
      } else {
        read(node, node.next++);
      }
    }
  }

  [[noreturn]] static void fail(const std::string& what) { throw std::runtime_error("octree: its data " + what); }

  const unsigned char* take(std::size_t count) {
    if (count > bytes_ - at_) fail("is cut short after " + std::to_string(bytes_) + " bytes");
    const unsigned char* const taken = data_ + at_;
    at_ += count;
    return taken;
  }

  unsigned children16() {
    const unsigned char* const bytes = take(2);
    return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
  }

  static Corner childOf(const Open& node, int i) {
    const std::uint32_t half = std::uint32_t{1} << (node.level - 1);
    Corner corner{};
    for (int k = 0; k < 3; ++k) corner.low[k] = node.low[k] + ((i >> k & 1) != 0 ? half : 0);
    return corner;
  }

  void push(const Corner& corner, int level, unsigned children) {
    if (level == 0) fail("is deeper than 16 levels");
    open_[depth_++] = {{corner.low[0], corner.low[1], corner.low[2]}, level, children, 0};
  }

  void readNode(const Corner& corner, int level, std::size_t colour) {
    float log_odds = 0.0F;
    std::memcpy(&log_odds, take(sizeof log_odds), sizeof log_odds);
    if (!std::isfinite(log_odds)) fail("holds log odds that are not finite");
    take(colour);
    const unsigned children = *take(1);
    if (children != 0) {
      push(corner, level, children);
    } else {
      leaf(corner, level, log_odds >= 0.0F);
    }
  }

  void leaf(const Corner& corner, int level, bool is_occupied) {
    OctreeLeaf found{};
    for (int k = 0; k < 3; ++k) found.low[k] = static_cast<std::uint16_t>(corner.low[k]);
    found.level = level;
    found.is_occupied = is_occupied;
    visit_(found);
  }

  const unsigned char* data_;
  std::size_t bytes_, at_ = 0;
  const std::function<void(const OctreeLeaf&)>& visit_;
  Open open_[kDepth + 1];
  int depth_ = 0;
};

}  // namespace

void visitLeaves(const std::int8_t* data, std::size_t bytes, OctreeData kind,
                 const std::function<void(const OctreeLeaf&)>& visit) {
  if (bytes == 0) return;  // a map without any known leaf
  LeafReader reader(data, bytes, visit);
  if (kind == OctreeData::kBinary) {
    reader.readBinary();
  } else {
    reader.readFull(kind == OctreeData::kFullColor ? 3 : 0);
  }
  reader.requireEnd();
}

}  // namespace sdf_ccd
