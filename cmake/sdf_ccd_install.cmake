# What is installed of the core, so that others' CMake finds it: with catkin by the file that catkin_package() makes.
install(TARGETS sdf_ccd_core EXPORT sdf_ccd_targets
  ARCHIVE DESTINATION ${SDF_CCD_LIB_DIR} LIBRARY DESTINATION ${SDF_CCD_LIB_DIR} RUNTIME DESTINATION ${SDF_CCD_BIN_DIR})
install(DIRECTORY include/sdf_ccd/ DESTINATION ${SDF_CCD_INCLUDE_DIR})
install(DIRECTORY config DESTINATION ${SDF_CCD_SHARE_DIR})
set_target_properties(sdf_ccd_core PROPERTIES EXPORT_NAME core)

if(NOT SDF_CCD_ROS)
  # The tool finds its library, and that its neighbours, wherever they are moved to together.
  file(RELATIVE_PATH to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(sdf_ccd_tool PROPERTIES INSTALL_RPATH "$ORIGIN/${to_lib}")
  set(config_dir ${SDF_CCD_LIB_DIR}/cmake/sdf_ccd)
  include(CMakePackageConfigHelpers)
  set(SDF_CCD_TBB_IS_TARGET FALSE)
  if(TARGET TBB::tbb)
    set(SDF_CCD_TBB_IS_TARGET TRUE)
  endif()
  configure_package_config_file(cmake/sdf_ccdConfig.cmake.in ${PROJECT_BINARY_DIR}/sdf_ccdConfig.cmake
    INSTALL_DESTINATION ${config_dir})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/sdf_ccdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/sdf_ccdConfig.cmake ${PROJECT_BINARY_DIR}/sdf_ccdConfigVersion.cmake
    DESTINATION ${config_dir})
  install(EXPORT sdf_ccd_targets NAMESPACE sdf_ccd:: FILE sdf_ccdTargets.cmake DESTINATION ${config_dir})
endif()
