# What is installed of the libraries, so that others' CMake finds them as sdf_ccd::core, ::robot and ::dynamics.
foreach(part core robot dynamics)
  add_library(sdf_ccd::${part} ALIAS sdf_ccd_${part})
  set_target_properties(sdf_ccd_${part} PROPERTIES EXPORT_NAME ${part} INSTALL_RPATH "$ORIGIN")
endforeach()
install(TARGETS sdf_ccd_core sdf_ccd_robot sdf_ccd_dynamics EXPORT sdf_ccd_targets
  ARCHIVE DESTINATION ${SDF_CCD_LIB_DIR} LIBRARY DESTINATION ${SDF_CCD_LIB_DIR} RUNTIME DESTINATION ${SDF_CCD_BIN_DIR})
install(DIRECTORY include/sdf_ccd/ DESTINATION ${SDF_CCD_INCLUDE_DIR})
install(DIRECTORY config DESTINATION ${SDF_CCD_SHARE_DIR})

if(SDF_CCD_ROS)
  # catkin_package() makes the configuration, which includes sdf_ccd_targets.cmake beside these.
  set(config_dir ${SDF_CCD_SHARE_DIR}/cmake)
  export(EXPORT sdf_ccd_targets NAMESPACE sdf_ccd:: FILE ${CATKIN_DEVEL_PREFIX}/share/sdf_ccd/cmake/sdf_ccdTargets.cmake)
else()
  # The tool finds its library, and that its neighbours, wherever they are moved to together.
  file(RELATIVE_PATH to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(sdf_ccd_tool PROPERTIES INSTALL_RPATH "$ORIGIN/${to_lib}")
  set(config_dir ${SDF_CCD_LIB_DIR}/cmake/sdf_ccd)
  include(CMakePackageConfigHelpers)
  configure_package_config_file(cmake/sdf_ccdConfig.cmake.in ${PROJECT_BINARY_DIR}/sdf_ccdConfig.cmake
    INSTALL_DESTINATION ${config_dir})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/sdf_ccdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  #catkin_lint: ignore_once missing_file
  install(FILES ${PROJECT_BINARY_DIR}/sdf_ccdConfig.cmake ${PROJECT_BINARY_DIR}/sdf_ccdConfigVersion.cmake
    cmake/sdf_ccd_targets.cmake DESTINATION ${config_dir})
endif()
install(EXPORT sdf_ccd_targets NAMESPACE sdf_ccd:: FILE sdf_ccdTargets.cmake DESTINATION ${config_dir})
