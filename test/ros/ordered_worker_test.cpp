#include "ros/monitor/ordered_worker.h"

#include <gtest/gtest.h>

#include <chrono>

#include "ros/messages/message_pool.h"

namespace sdf_ccd::ordered_worker_test {

TEST(OrderedWorker, WorksOnEveryItemInOrderWhicheverSideIsTheSlower) {
  constexpr int kItems = 300;
  for (const bool work_is_slow : {false, true}) {
    std::vector<int> seen;
    {
      OrderedWorker<int> worker(4, [&](int& item) {
        if (work_is_slow) std::this_thread::sleep_for(std::chrono::microseconds(100));
        seen.push_back(item);
      });
      for (int i = 0; i < kItems; ++i) {
        if (!work_is_slow && i % 10 == 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
        worker.next() = i;
        worker.handOver();
      }
    }  // the destructor processes items that still wait
    ASSERT_EQ(seen.size(), std::size_t(kItems));
    for (int i = 0; i < kItems; ++i) EXPECT_EQ(seen[std::size_t(i)], i);
  }
}

/// As pictures are drawn: what comes while others wait is left out.
TEST(OrderedWorker, SlowWorkNeedNotBeWaitedFor) {
  std::mutex slow;
  std::vector<int> seen;
  std::unique_lock<std::mutex> until_then(slow);
  {
    OrderedWorker<int> worker(4, [&](int& item) {
      const std::lock_guard<std::mutex> lock(slow);
      seen.push_back(item);
    });
    for (int i = 0; i < 100; ++i) {
      int* const item = worker.tryNext();
      ASSERT_EQ(item != nullptr, i < 4) << i;
      if (!item) continue;
      *item = i;
      worker.handOver();
    }
    until_then.unlock();
  }
  EXPECT_EQ(seen, (std::vector<int>{0, 1, 2, 3}));
}

TEST(OrderedWorker, ItemsKeepTheirMemory) {
  OrderedWorker<std::vector<int>> worker(2, [](std::vector<int>& item) { item.clear(); });
  for (int i = 0; i < 10; ++i) {
    std::vector<int>& item = worker.next();
    EXPECT_TRUE(item.empty());
    EXPECT_EQ(item.capacity() > 0, i >= 2) << i;
    item.assign(100, i);
    worker.handOver();
  }
}

TEST(MessagePool, GivesNoMessageThatSomebodyHolds) {
  MessagePool<int> pool;
  std::vector<boost::shared_ptr<int>> held;
  for (int i = 0; i < 100; ++i) {
    held.push_back(pool.acquire());
    EXPECT_EQ(*held.back(), 0);
    *held.back() = 1;
  }
  const int* const first = held.front().get();
  held.erase(held.begin());
  EXPECT_EQ(pool.acquire().get(), first);
}

}  // namespace sdf_ccd::ordered_worker_test
