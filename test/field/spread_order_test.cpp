#include "field/spread_order.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace sdf_ccd::spread_order_test {

TEST(SpreadOrder, MeetsEachOnceAndAnyFewInARowAreSpread) {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 60u, 64u, 100u, 4096u, 5040u, 99991u}) {
    const SpreadOrder order(count);
    std::vector<int> met(count, 0);
    for (std::size_t i = 0; i < count; ++i) ++met[order[i]];
    EXPECT_EQ(std::count(met.begin(), met.end(), 1), std::ptrdiff_t(count)) << count;
    // Of 32 numbers in a row, no eighth of the range contains more than twice its share.
    for (std::size_t first = 0; count >= 64 && first + 32 <= count; first += 32) {
      std::array<int, 8> in{};
      for (std::size_t i = first; i < first + 32; ++i) ++in[8 * order[i] / count];
      EXPECT_LE(*std::max_element(in.begin(), in.end()), 8) << count << " " << first;
    }
  }
}

}  // namespace sdf_ccd::spread_order_test
