#pragma once

#include <memory>
#include <utility>

namespace sdf_ccd {

/// An immutable value; copies of it share memory.
template <class T>
class SharedValue {
 public:
  SharedValue() : value_(empty()) {}
  SharedValue(T value) : value_(std::make_shared<const T>(std::move(value))) {}

  // Copied, never moved: a moved-from object keeps its value.
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
