# LCM as it really comes: 1.4 and later have a CMake package (broken in 1.5.2 without GLib2's), Debian 12's
# 1.3.1 has only a pkg-config file that asks for packages nobody installed. So: package, then pkg-config, then
# plain header and library. SPRUNG_LCM_WAY forces one of them (config, pkgconfig, plain), so that each can be
# tested.
set(SPRUNG_LCM_WAY "any" CACHE STRING "how to find LCM: any, config, pkgconfig, plain")
add_library(sprung_lcm INTERFACE)
set(SPRUNG_LCM_FOUND_BY "")

if(SPRUNG_LCM_WAY MATCHES "^(any|config)$")
  find_package(lcm CONFIG QUIET)
  # 1.4 calls its targets lcm::lcm and lcm::lcm-gen, 1.5 as installed from PyPI lcm and lcm-gen.
  foreach(target lcm::lcm lcm)
    if(lcm_FOUND AND TARGET ${target} AND NOT SPRUNG_LCM_FOUND_BY)
      target_link_libraries(sprung_lcm INTERFACE ${target})
      set(SPRUNG_LCM_FOUND_BY "CMake package")
      # What its generator writes fits its own headers: not another version's from the PATH.
      if(TARGET ${target}-gen)
        get_target_property(LCM_GEN ${target}-gen LOCATION)
      endif()
    endif()
  endforeach()
endif()

if(NOT SPRUNG_LCM_FOUND_BY AND SPRUNG_LCM_WAY MATCHES "^(any|pkgconfig)$")
  find_package(PkgConfig QUIET)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(LCM QUIET IMPORTED_TARGET lcm)
    if(LCM_FOUND)
      target_link_libraries(sprung_lcm INTERFACE PkgConfig::LCM)
      set(SPRUNG_LCM_FOUND_BY "pkg-config")
    endif()
  endif()
endif()

if(NOT SPRUNG_LCM_FOUND_BY AND SPRUNG_LCM_WAY MATCHES "^(any|plain)$")
  find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
  find_library(LCM_LIBRARY lcm)
  if(LCM_INCLUDE_DIR AND LCM_LIBRARY)
    target_include_directories(sprung_lcm SYSTEM INTERFACE ${LCM_INCLUDE_DIR})
    target_link_libraries(sprung_lcm INTERFACE ${LCM_LIBRARY})
    set(SPRUNG_LCM_FOUND_BY "header and library")
  endif()
endif()

if(NOT LCM_GEN)
  find_program(LCM_GEN lcm-gen)
endif()
if(NOT SPRUNG_LCM_FOUND_BY OR NOT LCM_GEN)
  message(FATAL_ERROR "LCM was not found (way: ${SPRUNG_LCM_WAY}). Run ./setup, or install liblcm-dev and liblcm-bin.")
endif()
message(STATUS "LCM found by ${SPRUNG_LCM_FOUND_BY}, generator ${LCM_GEN}")
