#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sdf_ccd {

/// Processes items in a thread of its own, in the order in which another thread hands them over. Items are reused with
/// their memory.
template <class Item>
class OrderedWorker {
 public:
  /// @param items  maximum number that waits at a time, 2 or more.
  /// @param work   must not throw.
  OrderedWorker(std::size_t items, std::function<void(Item&)> work)
      : items_(items), work_(std::move(work)), thread_([this] { run(); }) {}

  /// Processes the items that still wait.
  ~OrderedWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  OrderedWorker(const OrderedWorker&) = delete;
  OrderedWorker& operator=(const OrderedWorker&) = delete;

  /// An item to fill, with its contents after it was last processed; then call handOver(). Blocks while all items wait.
  Item& next() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ < items_.size(); });
    return items_[(first_ + waiting_) % items_.size()];
  }

  /// The same, but null while all items wait.
  Item* tryNext() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return waiting_ < items_.size() ? &items_[(first_ + waiting_) % items_.size()] : nullptr;
  }

  void handOver() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++waiting_;
    }
    changed_.notify_all();
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return waiting_ > 0 || is_stopping_; });
      if (waiting_ == 0) return;
      Item& item = items_[first_];
      lock.unlock();
      work_(item);
      lock.lock();
      first_ = (first_ + 1) % items_.size();
      --waiting_;
      changed_.notify_all();
    }
  }

  std::vector<Item> items_;
  std::function<void(Item&)> work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t first_ = 0, waiting_ = 0;  // number of items handed over, including the one that is processed
  bool is_stopping_ = false;
  std::thread thread_;
};

}  // namespace sdf_ccd
