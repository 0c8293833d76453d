#include "ros/bag/bag_writer.h"

#include <cstring>
#include <stdexcept>
#include <utility>

namespace sdf_ccd {

BagWriter::BagWriter(const std::string& file, std::string name)
    : name_(std::move(name)), bag_(std::make_unique<rosbag::Bag>()) {
  guarded([&] {
    bag_->open(file, rosbag::bagmode::Write);
    bag_->setCompression(rosbag::compression::LZ4);
  });
}

BagWriter::~BagWriter() {
  try {
    if (bag_) close();
  } catch (const std::runtime_error&) {
    // see the destructor's declaration
  }
}

void BagWriter::close() {
  guarded([&] { bag_->close(); });
}

void BagWriter::abandon(int error_number, const std::string& reason) {
  // The bag's destructor would try again to write, and throw; so it is never run. The program ends soon.
  static_cast<void>(bag_.release());
  throw std::runtime_error(name_ + ": cannot write: " + (error_number != 0 ? std::strerror(error_number) : reason));
}

}  // namespace sdf_ccd
