#pragma once

#include <stdexcept>
#include <string>

#include <rosbag/exceptions.h>

namespace sdf_ccd {

/// Throws if the file is missing or no bag. rosbag calls both damaged.
void requireBag(const std::string& file);

/// Calls what reads a bag, and says what rosbag throws so that it names the file and what to do.
/// @throws std::runtime_error
template <class Call>
void readBag(const std::string& file, const Call& call) {
  requireBag(file);
  try {
    call();
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(file + ": has no index, as if its recording had not ended: try `rosbag reindex " + file +
                             "`");
  } catch (const ros::Exception& error) {  // of the bag's format, or of a message's
    throw std::runtime_error(file + ": is cut short or damaged: " + error.what() + ": try `rosbag reindex " + file +
                             "`, which keeps what can be read");
  }
}

}  // namespace sdf_ccd
