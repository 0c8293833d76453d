#pragma once

#include <memory>
#include <utility>

namespace sdf_ccd {

/// A value that nobody changes, so that copies of it are the same one in memory.
template <class T>
class SharedValue {
 public:
  SharedValue() : value_(empty()) {}
  SharedValue(T value) : value_(std::make_shared<const T>(std::move(value))) {}

  // What is moved from keeps it, too.
  SharedValue(const SharedValue&) = default;
  SharedValue& operator=(const SharedValue&) = default;

  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }
  operator const T&() const { return *value_; }

 private:
  static const std::shared_ptr<const T>& empty() {
    static const auto none = std::make_shared<const T>();
    return none;
  }

  std::shared_ptr<const T> value_;
};

}  // namespace sdf_ccd
