#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <ros/serialization.h>
#include <rosbag/exceptions.h>
#include <rosbag/message_instance.h>
#include <rosbag/structures.h>
#include <boost/make_shared.hpp>

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

/// Throws if the connection's messages are of type Message, but of another definition: a reader would pass over them,
/// or misread them.
/// @param help  what to do about it.
template <class Message>
void requireDefinition(const rosbag::ConnectionInfo& connection, const std::string& file, const std::string& help) {
  const std::string ours = ros::message_traits::md5sum<Message>(), type = ros::message_traits::datatype<Message>();
  if (connection.datatype != type || connection.md5sum == ours) return;
  throw std::runtime_error(file + ": " + connection.topic + " holds " + type + " of another definition, " +
                           connection.md5sum + " instead of " + ours + ": " + help);
}

/// Reads a message. Memory for the elements of a list is reserved before they are read, whatever their number is, so
/// this is tested first: a damaged one could ask for more than the machine has.
class MessageStream : public ros::serialization::IStream {
 public:
  MessageStream(std::vector<std::uint8_t>& bytes, const std::string& topic)
      : IStream(bytes.data(), static_cast<std::uint32_t>(bytes.size())), topic_(topic) {}

  template <class T>
  void next(T& value) {
    ros::serialization::deserialize(*this, value);
  }
  /// @throws rosbag::BagFormatException
  template <class T, class Allocator>
  void next(std::vector<T, Allocator>& values) {
    static const std::uint32_t smallest = ros::serialization::serializationLength(T());
    std::uint32_t count = 0;
    if (getLength() >= sizeof count) std::memcpy(&count, getData(), sizeof count);
    if (std::uint64_t(count) * smallest > getLength())
      throw rosbag::BagFormatException("a message on " + topic_ + " has more elements than fit in it");
    ros::serialization::deserialize(*this, values);
  }

 private:
  const std::string& topic_;
};

/// A message of a bag; null if it is of another type.
/// @throws rosbag::BagFormatException also if it has a damaged number of elements.
template <class Message>
typename Message::ConstPtr messageOf(const rosbag::MessageInstance& message) {
  if (message.size() > largest_message)
    throw rosbag::BagFormatException("a message on " + message.getTopic() + " is longer than its chunk");
  if (!message.isType<Message>()) return nullptr;
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream to_bytes(bytes.data(), message.size());
  message.write(to_bytes);
  const auto read = boost::make_shared<Message>();
  MessageStream(bytes, message.getTopic()).next(*read);
  return read;
}

}  // namespace sdf_ccd
