#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include <rosbag/exceptions.h>
#include <rosbag/message_instance.h>

namespace sdf_ccd {

/// Throws if the file is missing or not a bag; rosbag would report both as a damaged bag.
void requireBag(const std::string& file);

/// Calls a function that reads a bag and translates what rosbag throws into messages with the file's name and a remedy.
/// @throws std::runtime_error
template <class Call>
void readBag(const std::string& file, const Call& call) {
  requireBag(file);
  try {
    call();
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(file + ": has no index, as if its recording had not ended: try `rosbag reindex " + file +
                             "`");
  } catch (const ros::Exception& error) {  // about the bag's format or a message's
    throw std::runtime_error(file + ": is cut short or damaged: " + error.what() + ": try `rosbag reindex " + file +
                             "`, which keeps what can be read");
  }
}

/// Memory that BudgetAllocator may still give to this thread.
inline thread_local std::size_t memory_budget = 0;

/// An allocator that gives no more than its thread has left of a budget, and throws std::bad_alloc beyond it.
template <class T>
class BudgetAllocator {
 public:
  using value_type = T;
  template <class U>
  struct rebind {
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

/// A message of a bag; null if it is of another type.
/// @throws rosbag::BagFormatException also if a damaged number of elements asks for more memory than the message's own
/// length explains.
template <class Message>
typename Message::ConstPtr messageOf(const rosbag::MessageInstance& message) {
  constexpr std::size_t kPerByte = 64;  // of a message in memory, per byte in the bag, and more than that
  memory_budget = kPerByte * (message.size() + 64);
  try {
    if (!message.instantiate<typename WithBudget<Message>::type>()) return nullptr;
  } catch (const std::bad_alloc&) {
    throw rosbag::BagFormatException("a message on " + message.getTopic() + " has more elements than fit in it");
  }
  return message.instantiate<Message>();
}

}  // namespace sdf_ccd
