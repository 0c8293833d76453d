#include "ros/bag/read_bag.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace sdf_ccd {

void requireBag(const std::string& file) {
  if (std::filesystem::is_directory(file)) throw std::runtime_error(file + ": is a directory, not a bag");
  const std::string kBegin = "#ROSBAG V";  // of all format versions
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + ": cannot be opened: " + std::strerror(errno));
  std::string begin(kBegin.size(), '\0');
  stream.read(&begin[0], static_cast<std::streamsize>(begin.size()));
  if (begin != kBegin) throw std::runtime_error(file + ": is not a bag");
}

}  // namespace sdf_ccd
