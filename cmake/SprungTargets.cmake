# One place for flags and for the three kinds of target, so that a folder's CMakeLists.txt is a list of files.

add_library(sprung_flags INTERFACE)
target_compile_options(sprung_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Werror
  # The same source must give the same bits in every process and on every CPU: no fused multiply-add.
  -ffp-contract=off)
target_include_directories(sprung_flags INTERFACE ${CMAKE_SOURCE_DIR})
if(SPRUNG_SANITIZE)
  # GCC 12 with sanitizers sees uninitialised members inside std::regex (a known false alarm); the sanitizers themselves look.
  target_compile_options(sprung_flags INTERFACE -Wno-maybe-uninitialized)
  target_compile_options(sprung_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  string(APPEND CMAKE_CXX_FLAGS " -O1")
  target_link_options(sprung_flags INTERFACE -fsanitize=address,undefined)
endif()

# sprung_library(NAME SOURCES a.cpp ... LINK x ...): a static library; headers are found from the top folder.
function(sprung_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC sprung_flags ${ARG_LINK})
endfunction()

add_custom_target(programs)  # all of them and no test

# sprung_program(NAME SOURCES a_main.cpp ... LINK x ...): a program in build/<preset>/bin.
function(sprung_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  add_dependencies(programs ${name})
  target_link_libraries(${name} PRIVATE sprung_flags ${ARG_LINK})
endfunction()

# Tests are more than half of all compiling: what they test is optimised, they need not be.
function(sprung_test_flags name)
  target_compile_options(${name} PRIVATE -O0)
  target_compile_definitions(${name} PRIVATE
    SPRUNG_SOURCE_DIR="${CMAKE_SOURCE_DIR}" SPRUNG_BIN_DIR="${CMAKE_BINARY_DIR}/bin")
endfunction()

# GoogleTest is compiled once for all of them: a precompiled header has 95 MB.
function(sprung_precompiled_googletest)
  if(TARGET sprung_googletest)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/sprung_googletest.cpp CONTENT "")
  add_library(sprung_googletest OBJECT ${CMAKE_BINARY_DIR}/sprung_googletest.cpp)
  target_link_libraries(sprung_googletest PRIVATE sprung_flags GTest::gmock)
  sprung_test_flags(sprung_googletest)
  target_precompile_headers(sprung_googletest PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
endfunction()

# sprung_tests(NAME SOURCES a_test.cpp ... LINK x ... [REALTIME filter]): a GoogleTest program; every case becomes a ctest. Cases
# that match the REALTIME filter run with nothing beside them, since whatever else runs steals their time, and have the label `realtime`:
# they alone are tried again where they fail (.ci/second-try).
function(sprung_tests name)
  cmake_parse_arguments(ARG "" "REALTIME" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE sprung_flags ${ARG_LINK} GTest::gmock GTest::gtest_main)
  sprung_test_flags(${name})
  sprung_precompiled_googletest()
  target_precompile_headers(${name} REUSE_FROM sprung_googletest)
  set(common TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
  if(ARG_REALTIME)
    gtest_discover_tests(${name} TEST_FILTER "${ARG_REALTIME}" TEST_LIST ${name}_realtime ${common} RUN_SERIAL TRUE LABELS realtime)
    gtest_discover_tests(${name} TEST_FILTER "-${ARG_REALTIME}" ${common})
  else()
    gtest_discover_tests(${name} ${common})
  endif()
endfunction()
