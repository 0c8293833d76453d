# catkin, the messages and catkin_package(): everything that must come before the targets.
find_package(catkin REQUIRED COMPONENTS
  diagnostic_updater dynamic_reconfigure geometry_msgs message_generation nodelet pluginlib rosbag roscpp
  roslib sensor_msgs shape_msgs std_msgs std_srvs tf2 tf2_msgs trajectory_msgs visualization_msgs)

file(GLOB SDF_CCD_MESSAGES RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/msg CONFIGURE_DEPENDS msg/*.msg)
file(GLOB SDF_CCD_SERVICES RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/srv CONFIGURE_DEPENDS srv/*.srv)
add_message_files(DIRECTORY msg FILES ${SDF_CCD_MESSAGES})
add_service_files(DIRECTORY srv FILES ${SDF_CCD_SERVICES})
generate_messages(DEPENDENCIES geometry_msgs sensor_msgs shape_msgs std_msgs trajectory_msgs)
generate_dynamic_reconfigure_options(cfg/CollisionMonitor.cfg cfg/VelocityScale.cfg)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES sdf_ccd_core sdf_ccd_robot sdf_ccd_dynamics
  CATKIN_DEPENDS dynamic_reconfigure geometry_msgs message_runtime sensor_msgs shape_msgs std_msgs std_srvs trajectory_msgs
  DEPENDS EIGEN3
  CFG_EXTRAS sdf_ccd_targets.cmake)

set(SDF_CCD_BIN_DIR ${CATKIN_PACKAGE_BIN_DESTINATION})
set(SDF_CCD_LIB_DIR ${CATKIN_PACKAGE_LIB_DESTINATION})
set(SDF_CCD_INCLUDE_DIR ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
set(SDF_CCD_SHARE_DIR ${CATKIN_PACKAGE_SHARE_DESTINATION})
