# Where a plain CMake installation, without ROS, puts what; with ROS sdf_ccd_catkin.cmake says it.
include(GNUInstallDirs)
set(SDF_CCD_BIN_DIR ${CMAKE_INSTALL_BINDIR})
set(SDF_CCD_LIB_DIR ${CMAKE_INSTALL_LIBDIR})
set(SDF_CCD_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/sdf_ccd)
set(SDF_CCD_SHARE_DIR ${CMAKE_INSTALL_DATADIR}/sdf_ccd)
