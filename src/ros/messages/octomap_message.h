#pragma once

/// octomap_msgs/Octomap, defined here if that package is absent: with the same fields, name and MD5 sum, it is the same
/// message to all publishers, recorders and players.
#if __has_include(<octomap_msgs/Octomap.h>)
#include <octomap_msgs/Octomap.h>
#else

#include <cstdint>
#include <string>
#include <vector>

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>
#include <boost/shared_ptr.hpp>

namespace octomap_msgs {

struct Octomap {
  std_msgs::Header header;
  std::uint8_t binary = 0;  ///< free and occupied only, no log odds
  std::string id;           ///< "OcTree", …
  double resolution = 0.0;  ///< size of a voxel [m]
  std::vector<std::int8_t> data;

  using Ptr = boost::shared_ptr<Octomap>;
  using ConstPtr = boost::shared_ptr<const Octomap>;
};

}  // namespace octomap_msgs

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<octomap_msgs::Octomap> {
  static constexpr std::uint64_t static_value1 = 0x9a45536b45c5e409ULL, static_value2 = 0xcd49f04bb2d9999fULL;
  static const char* value() { return "9a45536b45c5e409cd49f04bb2d9999f"; }
  static const char* value(const octomap_msgs::Octomap&) { return value(); }
};

template <>
struct DataType<octomap_msgs::Octomap> {
  static const char* value() { return "octomap_msgs/Octomap"; }
  static const char* value(const octomap_msgs::Octomap&) { return value(); }
};

template <>
struct Definition<octomap_msgs::Octomap> {
  static const char* value() {
    return "Header header\nbool binary\nstring id\nfloat64 resolution\nint8[] data\n"
           "================================================================================\n"
           "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";
  }
  static const char* value(const octomap_msgs::Octomap&) { return value(); }
};

template <>
struct HasHeader<octomap_msgs::Octomap> : TrueType {};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<octomap_msgs::Octomap> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.binary);
    stream.next(message.id);
    stream.next(message.resolution);
    stream.next(message.data);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros

#endif
