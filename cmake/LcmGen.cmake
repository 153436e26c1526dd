# sprung_lcm_types(TARGET file.lcm ...): C++ headers from message definitions, by our own rule (lcm#617: the
# rule that LCM ships breaks between versions). Package sprung_msgs; include as
# "sprung_msgs/drive_state_t.hpp".
function(sprung_lcm_types target)
  set(out_dir ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(headers "")
  foreach(file ${ARGN})
    set(path ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    file(STRINGS ${path} structs REGEX "^struct [a-z_0-9]+")
    set(outputs "")
    foreach(line ${structs})
      string(REGEX REPLACE "^struct ([a-z_0-9]+).*" "\\1" name ${line})
      list(APPEND outputs ${out_dir}/sprung_msgs/${name}.hpp)
    endforeach()
    add_custom_command(OUTPUT ${outputs}
      COMMAND ${LCM_GEN} --cpp --cpp-std=c++11 --cpp-hpath ${out_dir} ${path}
      DEPENDS ${path} COMMENT "lcm-gen ${file}" VERBATIM)
    list(APPEND headers ${outputs})
    set_property(GLOBAL APPEND PROPERTY SPRUNG_LCM_FILES ${path})  # tools/logs/fields builds them in
    set_property(GLOBAL APPEND PROPERTY SPRUNG_LCM_HEADERS ${outputs})
  endforeach()
  add_custom_target(${target}_generate DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_generate)
  target_include_directories(${target} SYSTEM INTERFACE $<BUILD_INTERFACE:${out_dir}>)
endfunction()
