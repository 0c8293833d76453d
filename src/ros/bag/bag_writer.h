#pragma once

#include <cerrno>
#include <memory>
#include <string>

#include <rosbag/bag.h>

namespace sdf_ccd {

/// Writes a bag, compressed with LZ4. On a full disk the destructor of rosbag::Bag throws, which ends the program; this
/// one's does not.
class BagWriter {
 public:
  /// @param file  to write.
  /// @param name  of the bag in error messages.
  /// @throws std::runtime_error if it cannot be written; so do all other functions.
  BagWriter(const std::string& file, std::string name);
  ~BagWriter();  ///< without close(), data that cannot be written is lost silently
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message,
             const boost::shared_ptr<ros::M_string>& connection = nullptr) {
    guarded([&] { bag_->write(topic, time, message, connection); });
  }

  /// Writes the last chunk and the index.
  void close();

 private:
  template <class Call>
  void guarded(const Call& call) {
    errno = 0;
    try {
      call();
    } catch (const rosbag::BagException& error) {
      abandon(errno, error.what());
    }
  }
  [[noreturn]] void abandon(int error_number, const std::string& reason);

  std::string name_;
  std::unique_ptr<rosbag::Bag> bag_;  // null after an error
};

}  // namespace sdf_ccd
