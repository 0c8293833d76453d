#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace sdf_ccd {

/// Values by key, for as long as they are in use elsewhere. Thread-safe.
template <class T>
class WeakStore {
 public:
  using Pointer = std::shared_ptr<const T>;

  /// Null if it is not in use.
  Pointer find(const std::string& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = kept_.find(key);
    return found == kept_.end() ? nullptr : found->second.lock();
  }

  /// @return the value under the key from now on: the former one, if somebody holds it.
  Pointer keep(const std::string& key, Pointer made) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (kept_.size() >= limit_) {
      for (auto kept = kept_.begin(); kept != kept_.end();)
        kept = kept->second.expired() ? kept_.erase(kept) : std::next(kept);
      limit_ = std::max(kMinLimit, 2 * kept_.size());
    }
    std::weak_ptr<const T>& kept = kept_[key];
    if (Pointer before = kept.lock()) return before;
    kept = made;
    return made;
  }

 private:
  static constexpr std::size_t kMinLimit = 256;

  std::mutex mutex_;
  std::unordered_map<std::string, std::weak_ptr<const T>> kept_;
  std::size_t limit_ = kMinLimit;  // size at which expired entries are removed
};

}  // namespace sdf_ccd
