#pragma once

#include <stdexcept>
#include <string>

#include <rosbag/exceptions.h>

namespace sdf_ccd {

/// Calls what reads a bag, and says what rosbag throws so that it names the file and what to do.
/// @throws std::runtime_error
template <class Call>
void readBag(const std::string& file, const Call& call) {
  try {
    call();
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(file + ": has no index, as if its recording had not ended: try rosbag reindex");
  } catch (const ros::Exception& error) {  // of the bag's format, or of a message's
    throw std::runtime_error(file + ": is not a bag, or cut short or damaged: " + error.what());
  }
}

}  // namespace sdf_ccd
