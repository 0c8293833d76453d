# sdf_ccd::core, ::robot and ::dynamics for those who find this package; sdf_ccdConfig.cmake includes it.
if(NOT TARGET sdf_ccd::core)  # in a workspace that is built as one they are there
  include(CMakeFindDependencyMacro)
  find_dependency(Threads)
  find_dependency(Eigen3)
  find_package(TBB CONFIG QUIET)  # where it has no configuration, the library alone is named
  include("${sdf_ccd_DIR}/sdf_ccdTargets.cmake")
  find_package(urdfdom_headers QUIET)  # of sdf_ccd::robot alone
  if(urdfdom_headers_FOUND)
    target_include_directories(sdf_ccd::robot SYSTEM INTERFACE ${urdfdom_headers_INCLUDE_DIRS})
  endif()
endif()
