# The cores for programs of other people: libraries, headers, message types, and find_package(sprung).
include(CMakePackageConfigHelpers)
set(SPRUNG_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/sprung)
set(SPRUNG_HEADERS_DIR ${CMAKE_INSTALL_INCLUDEDIR}/sprung)

# As they are called outside: sprung::model, ...
set(exported signals friction model robots estimator controller lcmtypes messages)
set(library_of_model sprung_leg)
foreach(name IN LISTS exported)
  set(library sprung_${name})
  if(library_of_${name})
    set(library ${library_of_${name}})
  endif()
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
  # <sprung/estimator/...> is what others write; the headers among themselves say "estimator/...".
  target_include_directories(${library} INTERFACE
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${SPRUNG_HEADERS_DIR}>)
  target_compile_features(${library} INTERFACE cxx_std_17)
  install(TARGETS ${library} EXPORT sprungTargets COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
endforeach()
install(EXPORT sprungTargets NAMESPACE sprung:: DESTINATION ${SPRUNG_CMAKE_DIR} COMPONENT development)

foreach(room signals model model/friction robots estimator controller lcmtypes)
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${room}/*.h)
  install(FILES ${headers} DESTINATION ${SPRUNG_HEADERS_DIR}/${room} COMPONENT development)
endforeach()
get_property(lcm_headers GLOBAL PROPERTY SPRUNG_LCM_HEADERS)
install(FILES ${lcm_headers} DESTINATION ${SPRUNG_HEADERS_DIR}/sprung_msgs COMPONENT development)

set(SPRUNG_ROBOTS ${CMAKE_INSTALL_DATADIR}/sprung/robots)
set(SPRUNG_LCMTYPES ${CMAKE_INSTALL_DATADIR}/sprung/lcmtypes)
configure_package_config_file(sprungConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/sprungConfig.cmake
  INSTALL_DESTINATION ${SPRUNG_CMAKE_DIR} PATH_VARS SPRUNG_ROBOTS SPRUNG_LCMTYPES)
# Until 1.0 every minor version may change what it declares.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/sprungConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sprungConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/sprungConfigVersion.cmake
  DESTINATION ${SPRUNG_CMAKE_DIR} COMPONENT development)
