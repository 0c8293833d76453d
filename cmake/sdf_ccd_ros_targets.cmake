# The ROS layer: the nodelet's library, the node that loads it, launch files.
file(GLOB SDF_CCD_ROS_SOURCES CONFIGURE_DEPENDS src/ros/*/*.cpp)
list(FILTER SDF_CCD_ROS_SOURCES EXCLUDE REGEX "_node\\.cpp$")
file(GLOB SDF_CCD_NODE_SOURCES CONFIGURE_DEPENDS src/ros/*/*_node.cpp)

if(SDF_CCD_ROS_SOURCES)
  add_library(sdf_ccd_ros SHARED ${SDF_CCD_ROS_SOURCES})
  add_dependencies(sdf_ccd_ros ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
  target_include_directories(sdf_ccd_ros PUBLIC src)
  #catkin_lint: ignore_once external_interface_path
  target_include_directories(sdf_ccd_ros SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
  target_link_libraries(sdf_ccd_ros sdf_ccd_robot sdf_ccd_dynamics fmt::fmt ${catkin_LIBRARIES})
  install(TARGETS sdf_ccd_ros LIBRARY DESTINATION ${SDF_CCD_LIB_DIR})
endif()

# The command line tool reads and writes bags where ROS is there.
file(GLOB SDF_CCD_BAG_SOURCES CONFIGURE_DEPENDS src/tools/ros/*.cpp)
target_sources(sdf_ccd_tool PRIVATE ${SDF_CCD_BAG_SOURCES})
target_link_libraries(sdf_ccd_tool sdf_ccd_ros)
target_compile_definitions(sdf_ccd_tool PRIVATE SDF_CCD_WITH_ROS)

foreach(source ${SDF_CCD_NODE_SOURCES})
  get_filename_component(node ${source} NAME_WE)
  string(REGEX REPLACE "_node$" "" node ${node})
  add_executable(sdf_ccd_${node} ${source})
  set_target_properties(sdf_ccd_${node} PROPERTIES OUTPUT_NAME ${node})
  target_include_directories(sdf_ccd_${node} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
  target_link_libraries(sdf_ccd_${node} ${catkin_LIBRARIES})
  install(TARGETS sdf_ccd_${node} RUNTIME DESTINATION ${SDF_CCD_BIN_DIR})
endforeach()

catkin_install_python(PROGRAMS scripts/after_monitor scripts/bag_states scripts/demo_motion scripts/demo_report
    scripts/shelf_map scripts/shelf_motion scripts/shelf_report DESTINATION ${SDF_CCD_BIN_DIR})
install(FILES scripts/demo_arm.py scripts/octomap_message.py scripts/robot_xml.py DESTINATION ${SDF_CCD_BIN_DIR})
install(FILES nodelet_plugins.xml package.xml DESTINATION ${SDF_CCD_SHARE_DIR})
install(DIRECTORY launch DESTINATION ${SDF_CCD_SHARE_DIR})
