# sdf_ccd::core, ::robot and ::dynamics for those who find this package; sdf_ccdConfig.cmake includes it.
if(NOT TARGET sdf_ccd::core)  # in a workspace that is built as one they are there
  include(CMakeFindDependencyMacro)
  find_dependency(Threads)
  find_package(TBB CONFIG QUIET)  # where it has no configuration, the library alone is named
  include("${sdf_ccd_DIR}/sdf_ccdTargets.cmake")
endif()
