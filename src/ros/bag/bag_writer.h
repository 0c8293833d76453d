#pragma once

#include <cerrno>
#include <memory>
#include <string>

#include <rosbag/bag.h>

namespace sdf_ccd {

/// A bag that is written, compressed with LZ4. A rosbag::Bag whose disk is full throws from its destructor too, which
/// ends the program; this one does not.
class BagWriter {
 public:
  /// @param file  to write.
  /// @param name  what errors call it.
  /// @throws std::runtime_error, as all that follows, if it cannot be written.
  BagWriter(const std::string& file, std::string name);
  ~BagWriter();  ///< without close(), what could not be written is lost without a word
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message,
             const boost::shared_ptr<ros::M_string>& connection = nullptr) {
    guarded([&] { bag_->write(topic, time, message, connection); });
  }

  /// Writes what is left: the last chunk, and the index.
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
