#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace sdf_ccd {

/// Memory that BudgetAllocator may still give to this thread.
inline thread_local std::size_t memory_budget = 0;

/// An allocator that gives no more than its thread has left of a budget, and throws std::bad_alloc beyond it.
template <class T>
class BudgetAllocator {
 public:
  using value_type = T;
  template <class U>
  struct rebind {  ///< generated messages use it
    using other = BudgetAllocator<U>;
  };

  BudgetAllocator() = default;
  template <class U>
  BudgetAllocator(const BudgetAllocator<U>&) {}  // NOLINT: allocators convert

  T* allocate(std::size_t count) {
    if (count > memory_budget / sizeof(T)) throw std::bad_alloc();
    memory_budget -= count * sizeof(T);
    return std::allocator<T>().allocate(count);
  }
  void deallocate(T* memory, std::size_t count) { std::allocator<T>().deallocate(memory, count); }

  template <class U>
  bool operator==(const BudgetAllocator<U>&) const {
    return true;
  }
  template <class U>
  bool operator!=(const BudgetAllocator<U>&) const {
    return false;
  }
};

/// A message type with that allocator.
template <class Message>
struct WithBudget;
template <template <class> class Message>
struct WithBudget<Message<std::allocator<void>>> {
  using type = Message<BudgetAllocator<void>>;
};

}  // namespace sdf_ccd
