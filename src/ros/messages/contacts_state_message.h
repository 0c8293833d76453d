#pragma once

/// gazebo_msgs/ContactsState, defined here if that package is absent: with the same fields, name and MD5 sum, it is the
/// same message to all subscribers, recorders and players.
#if __has_include(<gazebo_msgs/ContactsState.h>)
#include <gazebo_msgs/ContactsState.h>
#else

#include <string>
#include <vector>

#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>
#include <boost/shared_ptr.hpp>

namespace gazebo_msgs {

struct ContactState {
  std::string info, collision1_name, collision2_name;
  std::vector<geometry_msgs::Wrench> wrenches;
  geometry_msgs::Wrench total_wrench;
  std::vector<geometry_msgs::Vector3> contact_positions, contact_normals;
  std::vector<double> depths;
};

struct ContactsState {
  std_msgs::Header header;
  std::vector<ContactState> states;

  using Ptr = boost::shared_ptr<ContactsState>;
  using ConstPtr = boost::shared_ptr<const ContactsState>;
};

}  // namespace gazebo_msgs

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<gazebo_msgs::ContactsState> {
  static constexpr std::uint64_t static_value1 = 0xacbcb1601a8e525bULL, static_value2 = 0xf72509f18e6f668dULL;
  static const char* value() { return "acbcb1601a8e525bf72509f18e6f668d"; }
  static const char* value(const gazebo_msgs::ContactsState&) { return value(); }
};

template <>
struct DataType<gazebo_msgs::ContactsState> {
  static const char* value() { return "gazebo_msgs/ContactsState"; }
  static const char* value(const gazebo_msgs::ContactsState&) { return value(); }
};

template <>
struct Definition<gazebo_msgs::ContactsState> {
  static const char* value() {
    return "Header header\ngazebo_msgs/ContactState[] states\n"
           "================================================================================\n"
           "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
           "================================================================================\n"
           "MSG: gazebo_msgs/ContactState\nstring info\nstring collision1_name\nstring collision2_name\n"
           "geometry_msgs/Wrench[] wrenches\ngeometry_msgs/Wrench total_wrench\n"
           "geometry_msgs/Vector3[] contact_positions\ngeometry_msgs/Vector3[] contact_normals\nfloat64[] depths\n"
           "================================================================================\n"
           "MSG: geometry_msgs/Wrench\nVector3 force\nVector3 torque\n"
           "================================================================================\n"
           "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";
  }
  static const char* value(const gazebo_msgs::ContactsState&) { return value(); }
};

template <>
struct HasHeader<gazebo_msgs::ContactsState> : TrueType {};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<gazebo_msgs::ContactState> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.info);
    stream.next(message.collision1_name);
    stream.next(message.collision2_name);
    stream.next(message.wrenches);
    stream.next(message.total_wrench);
    stream.next(message.contact_positions);
    stream.next(message.contact_normals);
    stream.next(message.depths);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

template <>
struct Serializer<gazebo_msgs::ContactsState> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.states);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros

#endif
