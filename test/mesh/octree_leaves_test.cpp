#include "mesh/octree_leaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace sdf_ccd::octree_leaves_test {

using Bytes = std::vector<std::int8_t>;
using Leaves = std::map<std::tuple<int, int, int, int>, bool>;

Leaves leavesOf(const Bytes& bytes, OctreeData kind) {
  Leaves leaves;
  visitLeaves(bytes.data(), bytes.size(), kind, [&](const OctreeLeaf& leaf) {
    leaves[{leaf.low[0], leaf.low[1], leaf.low[2], leaf.level}] = leaf.is_occupied;
  });
  return leaves;
}

/// A tree made at random, written as OctoMap writes it, and its leaves.
class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  void binary(int level, int x, int y, int z) {
    unsigned bits = 0;
    int kinds[8];
    for (int i = 0; i < 8; ++i) {
      kinds[i] = int(random_() % 4);
      if (kinds[i] == 3 && (level == 1 || random_() % 3 == 0)) kinds[i] = 2;
      if (level > 13 && kinds[i] != 3 && random_() % 2 == 0) kinds[i] = 3;
      bits |= unsigned(kinds[i]) << (2 * i);
    }
    bytes.push_back(std::int8_t(bits & 255U));
    bytes.push_back(std::int8_t(bits >> 8));
    const int half = 1 << (level - 1);
    for (int i = 0; i < 8; ++i) {
      const int cx = x + (i & 1) * half, cy = y + (i >> 1 & 1) * half, cz = z + (i >> 2) * half;
      if (kinds[i] == 1 || kinds[i] == 2) leaves[{cx, cy, cz, level - 1}] = kinds[i] == 2;
      if (kinds[i] == 3) binary(level - 1, cx, cy, cz);
    }
  }

  Bytes bytes;
  Leaves leaves;

 private:
  std::mt19937 random_;
};

TEST(OctreeLeaves, ReadsWhatABinaryTreeHolds) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    RandomTree tree(seed);
    tree.binary(16, 0, 0, 0);
    EXPECT_EQ(leavesOf(tree.bytes, OctreeData::kBinary), tree.leaves);
    EXPECT_GT(tree.leaves.size(), 20U);
  }
}

TEST(OctreeLeaves, ReadsTheFullFormatWithAndWithoutColour) {
  for (const bool colour : {false, true}) {
    Bytes bytes;
    const auto node = [&](float log_odds, int children) {
      const auto* raw = reinterpret_cast<const std::int8_t*>(&log_odds);
      bytes.insert(bytes.end(), raw, raw + 4);
      if (colour) bytes.insert(bytes.end(), 3, 7);
      bytes.push_back(std::int8_t(children));
    };
    node(1.0F, 0x81);  // the root: first and last child
    node(-0.4F, 0);    // free
    node(2.0F, 0x02);  // the last, and its second child
    node(0.85F, 0);    // occupied
    const Leaves wanted{{{0, 0, 0, 15}, false}, {{49152, 32768, 32768, 14}, true}};
    EXPECT_EQ(leavesOf(bytes, colour ? OctreeData::kFullColor : OctreeData::kFull), wanted);
    for (std::size_t size = 1; size < bytes.size(); ++size)
      EXPECT_THROW(leavesOf(Bytes(bytes.begin(), bytes.begin() + long(size)),
                            colour ? OctreeData::kFullColor : OctreeData::kFull),
                   std::runtime_error);
  }
}

TEST(OctreeLeaves, RefusesWhatIsNoTree) {
  RandomTree tree(5);
  tree.binary(16, 0, 0, 0);
  for (std::size_t size = 1; size < std::min<std::size_t>(tree.bytes.size(), 3000); size += 7)
    EXPECT_THROW(leavesOf(Bytes(tree.bytes.begin(), tree.bytes.begin() + long(size)), OctreeData::kBinary),
                 std::runtime_error);
  Bytes longer = tree.bytes;
  longer.push_back(0);
  EXPECT_THROW(leavesOf(longer, OctreeData::kBinary), std::runtime_error);
  EXPECT_THROW(leavesOf(Bytes(1000, -1), OctreeData::kBinary), std::runtime_error);  // children all the way down
  EXPECT_TRUE(leavesOf({}, OctreeData::kBinary).empty());
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    Bytes noise(random() % 200);
    for (std::int8_t& byte : noise) byte = std::int8_t(random());
    try {
      leavesOf(noise, OctreeData(i % 3));
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace sdf_ccd::octree_leaves_test
