#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include <rosbag/exceptions.h>
#include <rosbag/message_instance.h>

#include "ros/bag/budget_allocator.h"

namespace sdf_ccd {

/// Throws if the file is missing or not a bag; rosbag would report both as a damaged bag.
void requireBag(const std::string& file);

/// Throws if records reach beyond the file, or its index gives messages times or places that their chunks do not have.
/// rosbag trusts the index: one damaged time would spread a bag over hours, or years.
/// @return the size of the largest chunk, which no message can exceed [bytes]; of a bag without an index, or of an
/// older format, no limit.
std::size_t requireSoundIndex(const std::string& file);

/// What requireSoundIndex() has returned for the bag that is read.
inline thread_local std::size_t largest_message = std::numeric_limits<std::size_t>::max();

/// Calls a function that reads a bag and translates what rosbag throws into messages with the file's name and a remedy.
/// @throws std::runtime_error
template <class Call>
void readBag(const std::string& file, const Call& call) {
  requireBag(file);
  try {
    largest_message = requireSoundIndex(file);
    call();
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(file + ": has no index, as if its recording had not ended: try `rosbag reindex " + file +
                             "`");
  } catch (const ros::Exception& error) {  // about the bag's format or a message's
    throw std::runtime_error(file + ": is cut short or damaged: " + error.what() + ": try `rosbag reindex " + file +
                             "`, which keeps what can be read");
  }
}

/// A message of a bag; null if it is of another type.
/// @throws rosbag::BagFormatException also if a damaged number of elements asks for more memory than the message's own
/// length explains.
template <class Message>
typename Message::ConstPtr messageOf(const rosbag::MessageInstance& message) {
  if (message.size() > largest_message)
    throw rosbag::BagFormatException("a message on " + message.getTopic() + " is longer than its chunk");
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
