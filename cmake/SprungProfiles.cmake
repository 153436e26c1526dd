# A device profile is one folder under drivers/profiles with a CMakeLists.txt of one call:
#
#   sprung_profile(NAME SOURCES a.cpp ... DEVICE_SOURCES b.cpp ... EDS NAME.eds EXTRA NAME.extra.ini)
#
# SOURCES is the bridge's side, DEVICE_SOURCES the simulated device; either may be left out. They define
# `const ProfileKind NAME_profile_kind` and `const DeviceKind NAME_device_kind` in namespace sprung::profiles
# (drivers/profiles/profile_registry.h, simulation/device_registry.h). EDS is built in once, for both sides:
# `sprung::NAME_eds_text()` of "sprung_embedded/NAME_eds_text.h"; EXTRA, the units and PDO directions beside
# it (drivers/canopen/eds.h), likewise as `NAME_eds_extra_text()`. The folders are found, not listed, so that
# a new one needs no change elsewhere.

function(sprung_profile name)
  cmake_parse_arguments(ARG "" "EDS;EXTRA" "SOURCES;DEVICE_SOURCES" ${ARGN})
  set(eds "")
  if(ARG_EDS)
    set(eds sprung_profile_eds_${name})
    add_library(${eds} STATIC)
    target_link_libraries(${eds} PUBLIC sprung_flags)
    sprung_embed_text(${eds} FILE ${ARG_EDS} SYMBOL ${name}_eds_text)
  endif()
  if(ARG_EXTRA)
    sprung_embed_text(${eds} FILE ${ARG_EXTRA} SYMBOL ${name}_eds_extra_text)
  endif()
  if(ARG_SOURCES)
    sprung_library(sprung_profile_${name} SOURCES ${ARG_SOURCES} LINK ${eds} sprung_canopen sprung_cia402)
    set_property(GLOBAL APPEND PROPERTY SPRUNG_PROFILE_NAMES ${name})
  endif()
  if(ARG_DEVICE_SOURCES)
    sprung_library(sprung_device_${name} SOURCES ${ARG_DEVICE_SOURCES} LINK ${eds} sprung_sim_node)
    set_property(GLOBAL APPEND PROPERTY SPRUNG_DEVICE_NAMES ${name})
  endif()
endfunction()

# sprung_kind_list(OUTPUT TEMPLATE TYPE SUFFIX NAME...): a source that lists `TYPE NAME_SUFFIX` of every name.
function(sprung_kind_list output template type suffix)
  set(DECLARATIONS "")
  set(ADDRESSES "")
  foreach(name IN LISTS ARGN)
    string(APPEND DECLARATIONS "extern const ${type} ${name}_${suffix};\n")
    string(APPEND ADDRESSES "&profiles::${name}_${suffix}, ")
  endforeach()
  configure_file(${template} ${output} @ONLY)
endfunction()
