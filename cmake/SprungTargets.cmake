# One place for flags and for the three kinds of target, so that a folder's CMakeLists.txt is a list of files.

# A quicker linker where there is one: mold, else lld.
find_program(MOLD mold)
find_program(LLD ld.lld)
if(MOLD)
  add_link_options(-fuse-ld=mold)
elseif(LLD)
  add_link_options(-fuse-ld=lld)
endif()

add_library(sprung_flags INTERFACE)
target_compile_options(sprung_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  # The same source must give the same bits in every process and on every CPU: no fused multiply-add.
  -ffp-contract=off)
# A warning is an error with the compiler that the sources are kept clean with. Another one warns of other
# things, which may not keep a user from a robot that works.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(sprung_flags INTERFACE -Werror)
endif()
if(SPRUNG_BATCH)
  # It asks whether a type is in the file that is compiled or in an included one, and here every source is
  # included.
  target_compile_options(sprung_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
target_include_directories(sprung_flags INTERFACE ${CMAKE_SOURCE_DIR})
if(SPRUNG_SANITIZE)
  # GCC 12 with sanitizers sees uninitialised members inside std::regex (a known false alarm); the sanitizers
  # themselves look.
  target_compile_options(sprung_flags INTERFACE -Wno-maybe-uninitialized)
  target_compile_options(sprung_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  string(APPEND CMAKE_CXX_FLAGS " -O1")
  target_link_options(sprung_flags INTERFACE -fsanitize=address,undefined)
endif()
if(SPRUNG_FUZZ)
  # A number that does not fit its integer is no part of clang's `undefined`, and is what a NaN off the wire
  # does.
  set(sprung_fuzz_checks -fsanitize=address,undefined,float-cast-overflow)
  target_compile_options(sprung_flags INTERFACE -fsanitize=fuzzer-no-link ${sprung_fuzz_checks} -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_compile_definitions(sprung_flags INTERFACE _GLIBCXX_ASSERTIONS)
  string(APPEND CMAKE_CXX_FLAGS " -O1")
  target_link_options(sprung_flags INTERFACE ${sprung_fuzz_checks})
endif()
if(SPRUNG_COVERAGE)
  target_compile_options(sprung_flags INTERFACE --coverage -fprofile-update=atomic)
  string(APPEND CMAKE_CXX_FLAGS " -O1")
  target_link_options(sprung_flags INTERFACE --coverage)
endif()

# What nearly every source reads, read once: for presets that build from nothing. A source still includes what
# it uses, which the develop preset checks by going without.
set(sprung_common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <set>
  <sstream> <string> <vector> <Eigen/Core>)

# sprung_precompile(NAME OWNER [HEADER...]): the headers are compiled once, by the object library OWNER, which
# NAME's flags must match.
function(sprung_precompile name owner)
  if(SPRUNG_PRECOMPILED)
    target_precompile_headers(${name} REUSE_FROM ${owner})
  endif()
endfunction()

# sprung_precompiled(OWNER HEADER...): an object library that holds these headers, compiled.
function(sprung_precompiled owner)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${owner}.cpp CONTENT "")
  add_library(${owner} OBJECT ${CMAKE_BINARY_DIR}/${owner}.cpp)
  target_link_libraries(${owner} PRIVATE sprung_flags Eigen3::Eigen)
  target_precompile_headers(${owner} PRIVATE ${ARGN})
endfunction()
if(SPRUNG_PRECOMPILED)
  sprung_precompiled(sprung_common ${sprung_common_headers})
endif()

# sprung_batches(OUT NAME SOURCE...): where SPRUNG_BATCH is set, sources that include so many of the given
# ones each, so that what these share is read once a batch. CMake's own unity files name absolute paths, with
# which another clone finds nothing in ccache.
function(sprung_batches out name)
  set(${out} ${ARGN} PARENT_SCOPE)
  list(LENGTH ARGN count)
  if(NOT SPRUNG_BATCH OR count LESS 2)
    return()
  endif()
  # As many batches as are needed, of about the same size.
  math(EXPR batches "(${count} + ${SPRUNG_BATCH} - 1) / ${SPRUNG_BATCH}")
  math(EXPR size "(${count} + ${batches} - 1) / ${batches}")
  set(files "")
  foreach(batch RANGE 1 ${batches})
    math(EXPR first "(${batch} - 1) * ${size}")
    list(SUBLIST ARGN ${first} ${size} sources)
    set(text "")
    foreach(source IN LISTS sources)
      file(REAL_PATH ${source} path BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
      file(RELATIVE_PATH path ${CMAKE_SOURCE_DIR} ${path})
      string(APPEND text "#include \"${path}\"\n")
    endforeach()
    set(file ${CMAKE_CURRENT_BINARY_DIR}/batches/${name}_${batch}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    list(APPEND files ${file})
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()

# sprung_library(NAME SOURCES a.cpp ... LINK x ...): a static library; headers are found from the top folder.
# Our warnings are errors in this tree alone: what is installed (tools/install) goes without the flags.
function(sprung_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  sprung_batches(sources ${name} ${ARG_SOURCES})
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:sprung_flags> ${ARG_LINK})
  sprung_precompile(${name} sprung_common)
endfunction()

add_custom_target(programs)  # all of them and no test

# sprung_program(NAME SOURCES a_main.cpp ... LINK x ...): a program in build/<preset>/bin.
function(sprung_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  sprung_batches(sources ${name} ${ARG_SOURCES})
  add_executable(${name} ${sources})
  add_dependencies(programs ${name})
  target_link_libraries(${name} PRIVATE sprung_flags ${ARG_LINK})
  sprung_precompile(${name} sprung_common)
endfunction()

# Tests are more than half of all compiling: what they test is optimised, they need not be.
function(sprung_test_flags name)
  target_compile_options(${name} PRIVATE -O0)
endfunction()

# sprung_tests(NAME SOURCES a_test.cpp ... LINK x ... [REALTIME filter] [COST seconds]): a GoogleTest program;
# every suite becomes a ctest. Cases that match the REALTIME filter are a ctest each, labelled `realtime`, and
# run with nothing beside them: whatever else runs steals their time. COST says about how long a suite takes,
# where that is much: ctest starts the longest first.
function(sprung_tests name)
  cmake_parse_arguments(ARG "" "REALTIME;COST" "SOURCES;LINK" ${ARGN})
  sprung_batches(sources ${name} ${ARG_SOURCES})
  add_executable(${name} ${sources})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE sprung_flags sprung_test_paths ${ARG_LINK} GTest::gmock GTest::gtest_main)
  sprung_test_flags(${name})
  sprung_precompile(${name} sprung_googletest)
  if(NOT ARG_COST)
    set(ARG_COST 1)
  endif()
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT
    "set(NAME @name@)\nset(PROGRAM \"@CMAKE_BINARY_DIR@/tests/@name@\")\nset(FOLDER \"@CMAKE_CURRENT_BINARY_DIR@\")
set(REALTIME \"@ARG_REALTIME@\")\nset(COST @ARG_COST@)\ninclude(\"@CMAKE_SOURCE_DIR@/cmake/TestSuites.cmake\")\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${file})
endfunction()
