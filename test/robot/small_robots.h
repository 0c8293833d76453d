#pragma once

#include <string>

namespace sdf_ccd::test {

/// base –(shoulder, z)– upper –(fixed)– bracket –(elbow, y)– fore –(slide, x)– tip, and a finger that
/// mimics slide.
inline const char* const kArm = R"(<?xml version="1.0"?>
<!-- a comment -- with dashes, as calibrated robots have -->
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="bracket"/><link name="fore"/><link name="tip"/>
  <link name="finger"/><link name="wheel"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 1"/><axis xyz="0 0 2"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="mount" type="fixed"><parent link="upper"/><child link="bracket"/><origin xyz="0.5 0 0"/></joint>
  <joint name="elbow" type="revolute"><parent link="bracket"/><child link="fore"/>
    <origin xyz="0 0 0.2"/><axis xyz="0 1 0"/><limit lower="0.1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="fore"/><child link="tip"/>
    <origin xyz="0.3 0 0"/><axis xyz="1 0 0"/><limit lower="-0.05" upper="0.1" effort="1" velocity="1"/></joint>
  <joint name="grip" type="prismatic"><parent link="tip"/><child link="finger"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.2" effort="1" velocity="1"/>
    <mimic joint="slide" multiplier="2" offset="0.01"/></joint>
  <joint name="spin" type="continuous"><parent link="base"/><child link="wheel"/>
    <origin xyz="0 0.4 0" rpy="1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
</robot>)";

inline std::string twoLinks(const std::string& joint) {
  return "<robot name='r'><link name='a'/><link name='b'/>" + joint + "</robot>";
}

}  // namespace sdf_ccd::test
