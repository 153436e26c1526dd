# cpack -G DEB in build/release: `sprung`, what a robot needs, and `libsprung-dev`, the cores for other
# people's programs. What differs from cmake --install is done to the staged files by debian/stage.cmake:
# robots and settings go to /etc as files that dpkg keeps where somebody has changed them.
set(SPRUNG_MAINTAINER "sprung authors <sprung@sprung.invalid>" CACHE STRING "who answers for the Debian packages")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sprung)
set(CPACK_PACKAGE_CONTACT ${SPRUNG_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "virtual springs for geared legged robots")
# Paths inside are those of the installed system: the unit has one.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME sprung)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS iproute2)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS liblcm-bin)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "can-utils, chromium, default-jre, ffmpeg, libegl1, libgl1-mesa-dri, libjchart2d-java, liblcm-java")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
  "Compliant torque control of harmonic-drive legged robots with no torque sensor\nand no mechanical spring: torque is estimated from motor current and encoders.\nSeparate processes exchange LCM messages; drives hang on CANopen, and simulated\ndrives stand in for them on the same frames.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/debian/postinst
  ${CMAKE_CURRENT_SOURCE_DIR}/debian/prerm ${CMAKE_CURRENT_SOURCE_DIR}/debian/postrm
  ${CMAKE_CURRENT_BINARY_DIR}/debian/conffiles)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsprung-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "cmake, g++, liblcm-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Torque estimator, leg controller, leg kinematics and messages of sprung as\nstatic libraries with headers and a CMake package, for other people's programs.")

# Read by cpack: versions are known when the programs have been built.
configure_file(debian/version.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/debian/version.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_BINARY_DIR}/debian/version.cmake)
file(READ ${CMAKE_SOURCE_DIR}/LICENSE LICENSE)
configure_file(debian/copyright.in ${CMAKE_CURRENT_BINARY_DIR}/debian/copyright @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/debian/stage.cmake)
set(CPACK_SPRUNG_WORK_DIR ${CMAKE_CURRENT_BINARY_DIR}/debian)
include(CPack)
