# Version and git hash go into every hello message. The hash is read at each build, by a script that touches
# its output only when it changed.
add_custom_target(sprung_version_file
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
    -DOUTPUT=${CMAKE_BINARY_DIR}/generated/sprung_version.h -P ${CMAKE_SOURCE_DIR}/cmake/WriteVersion.cmake
  BYPRODUCTS ${CMAKE_BINARY_DIR}/generated/sprung_version.h VERBATIM)
add_library(sprung_version INTERFACE)
add_dependencies(sprung_version sprung_version_file)
target_include_directories(sprung_version INTERFACE ${CMAKE_BINARY_DIR}/generated)
