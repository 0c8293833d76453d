#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

#include "sdf_ccd/body/body.h"

namespace sdf_ccd {

/// Bodies by index. Lists share bodies: a copy of a list copies no body, and two lists hold the same body if shared()
/// returns the same pointer.
class BodyList {
 public:
  using Shared = std::shared_ptr<const Body>;

  class const_iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = Body;
    using difference_type = std::ptrdiff_t;
    using pointer = const Body*;
    using reference = const Body&;

    const_iterator() = default;
    explicit const_iterator(std::vector<Shared>::const_iterator at) : at_(at) {}
    const Body& operator*() const { return **at_; }
    const Body* operator->() const { return at_->get(); }
    const_iterator& operator++() { return ++at_, *this; }
    const_iterator operator++(int) { return const_iterator(at_++); }
    const_iterator& operator--() { return --at_, *this; }
    const_iterator& operator+=(std::ptrdiff_t n) { return at_ += n, *this; }
    const_iterator operator+(std::ptrdiff_t n) const { return const_iterator(at_ + n); }
    std::ptrdiff_t operator-(const const_iterator& other) const { return at_ - other.at_; }
    bool operator==(const const_iterator& other) const { return at_ == other.at_; }
    bool operator!=(const const_iterator& other) const { return at_ != other.at_; }

   private:
    std::vector<Shared>::const_iterator at_;
  };

  BodyList() = default;
  explicit BodyList(std::vector<Body> bodies) {
    for (Body& body : bodies) push_back(std::move(body));
  }

  std::size_t size() const { return bodies_.size(); }
  bool empty() const { return bodies_.empty(); }
  const Body& operator[](std::size_t i) const { return *bodies_[i]; }
  const Body& front() const { return *bodies_.front(); }
  const Body& back() const { return *bodies_.back(); }
  const_iterator begin() const { return const_iterator(bodies_.begin()); }
  const_iterator end() const { return const_iterator(bodies_.end()); }
  const Shared& shared(std::size_t i) const { return bodies_[i]; }

  void push_back(Body body) { bodies_.push_back(std::make_shared<const Body>(std::move(body))); }
  void push_back(Shared body) { bodies_.push_back(std::move(body)); }

  /// Replaces the body by a copy that only this list holds, to be modified. The reference is valid until the next call.
  Body& edit(std::size_t i) {
    auto own = std::make_shared<Body>(*bodies_[i]);
    Body& body = *own;
    bodies_[i] = std::move(own);
    return body;
  }

 private:
  std::vector<Shared> bodies_;
};

}  // namespace sdf_ccd
