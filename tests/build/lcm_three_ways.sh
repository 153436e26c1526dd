#!/usr/bin/env bash
# Configures a tiny project with each way of cmake/FindLcmThreeWays.cmake, then `any` where only one
# way is open.
set -euo pipefail
source_dir=$1
work=$2
rm -rf "$work"
mkdir -p "$work/project" "$work/prefix/lib/cmake/lcm" "$work/prefix/lib/pkgconfig"

cat >"$work/project/CMakeLists.txt" <<EOT
cmake_minimum_required(VERSION 3.22)
project(ways CXX)
# Packages beside the programs on the PATH are found too: another LCM there is none of this test's.
set(CMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH OFF)
include($source_dir/cmake/FindLcmThreeWays.cmake)
file(WRITE \${CMAKE_BINARY_DIR}/probe.cpp "#include <lcm/lcm.h>\nint main() { lcm_destroy(lcm_create(\"memq://\")); }\n")
add_executable(probe \${CMAKE_BINARY_DIR}/probe.cpp)
target_link_libraries(probe sprung_lcm)
EOT
# As LCM 1.4 and later install it.
cat >"$work/prefix/lib/cmake/lcm/lcmConfig.cmake" <<'EOT'
add_library(lcm::lcm INTERFACE IMPORTED)
set_target_properties(lcm::lcm PROPERTIES INTERFACE_LINK_LIBRARIES lcm)
EOT
# As LCM 1.5 from PyPI installs it: other names, and a generator of its own.
mkdir -p "$work/prefix15/lib/cmake/lcm" "$work/prefix15/bin"
cat >"$work/prefix15/lib/cmake/lcm/lcmConfig.cmake" <<EOT
add_library(lcm INTERFACE IMPORTED)
set_target_properties(lcm PROPERTIES INTERFACE_LINK_LIBRARIES -llcm)
add_executable(lcm-gen IMPORTED)
set_target_properties(lcm-gen PROPERTIES IMPORTED_LOCATION $work/prefix15/bin/lcm-gen)
EOT
# As Debian's would be without its wrong requirements.
cat >"$work/prefix/lib/pkgconfig/lcm.pc" <<'EOT'
Name: lcm
Description: stand-in
Version: 1.3.1
Libs: -llcm
EOT

expect() { # way, what must be said, options...
  local way=$1 said=$2 build
  shift 2
  build=$(mktemp -d "$work/build.XXXX")
  cmake -S "$work/project" -B "$build" -DSPRUNG_LCM_WAY="$way" "$@" >"$build/log" 2>&1 || { cat "$build/log"; exit 1; }
  grep -q "LCM found by $said" "$build/log" || { echo "way $way: expected '$said'"; cat "$build/log"; exit 1; }
  cmake --build "$build" >>"$build/log" 2>&1 || { cat "$build/log"; exit 1; }
  "$build/probe"
}

export PKG_CONFIG_LIBDIR=$work/nothing
expect config "CMake package" -DCMAKE_PREFIX_PATH="$work/prefix"
expect any "CMake package" -DCMAKE_PREFIX_PATH="$work/prefix"
expect config "CMake package, generator $work/prefix15/bin/lcm-gen" -DCMAKE_PREFIX_PATH="$work/prefix15"
expect plain "header and library"
expect any "header and library"
export PKG_CONFIG_LIBDIR=$work/prefix/lib/pkgconfig
expect pkgconfig "pkg-config"
expect any "pkg-config"
echo "LCM is found in three ways"
